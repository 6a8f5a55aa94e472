"""Navigation goals from Python."""
