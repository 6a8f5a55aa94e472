"""Names of ROS 1."""

from rospy.names import (
    PRIV_NAME,
    REMAP,
    SEP,
    anonymous_name,
    canonicalize_name,
    get_caller_id,
    is_global,
    is_legal_base_name,
    is_legal_name,
    is_private,
    load_mappings,
    namespace,
    ns_join,
    resolve_name,
    scoped_name,
)

get_ros_namespace = namespace
make_global_ns = lambda name: name if name.endswith("/") else f"/{name.strip('/')}/"  # noqa: E731

__all__ = [
    "PRIV_NAME",
    "REMAP",
    "SEP",
    "anonymous_name",
    "canonicalize_name",
    "get_caller_id",
    "get_ros_namespace",
    "is_global",
    "is_legal_base_name",
    "is_legal_name",
    "is_private",
    "load_mappings",
    "make_global_ns",
    "namespace",
    "ns_join",
    "resolve_name",
    "scoped_name",
]
