"""The table of Shor and Van Wyk: which pairs hold, and counting, sampling, optima and immersions from their splits."""
