"""From one immersed disk to another (Sections 5 and 6)."""
