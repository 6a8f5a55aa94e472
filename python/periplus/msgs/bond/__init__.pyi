from periplus.msgs.bond import msg as msg

__all__ = ["msg"]
