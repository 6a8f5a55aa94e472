"""Types of message fields."""
