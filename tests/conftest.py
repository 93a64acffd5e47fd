"""How hypothesis looks for counterexamples: HYPOTHESIS_PROFILE is "ci" (repeatable) or "explore"."""

import os

from hypothesis import HealthCheck, settings

# A first call may compile a kernel, so neither one example nor the making of one has a time limit.
settings.register_profile(
    "ci", deadline=None, derandomize=True, database=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile(
    "explore", deadline=None, max_examples=2000, suppress_health_check=[HealthCheck.too_slow], print_blob=True
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))
