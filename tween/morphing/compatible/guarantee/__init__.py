"""The proof that every shape bounds an immersed disk, in the doubles that people get: bounds, budgets, rounding."""
