"""Message classes by name."""

from genpy import Message, get_message_class, get_service_class, strify_message

__all__ = ["Message", "get_message_class", "get_service_class", "strify_message"]
