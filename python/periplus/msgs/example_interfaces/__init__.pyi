from periplus.msgs.example_interfaces import action as action

__all__ = ["action"]
