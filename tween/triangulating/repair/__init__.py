"""What to do where a curve bounds no disk: why, what would mend it, and a stroke made clean."""
