"""The studies, a module each: `experiments.catalogue` lists them."""
