"""The command `tween`."""
