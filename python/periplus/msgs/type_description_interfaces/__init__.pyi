from periplus.msgs.type_description_interfaces import msg as msg
from periplus.msgs.type_description_interfaces import srv as srv

__all__ = ["msg", "srv"]
