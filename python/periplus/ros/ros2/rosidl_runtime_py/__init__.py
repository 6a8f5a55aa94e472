"""Messages by the names of their types, and as dictionaries, YAML and CSV."""

from rosidl_runtime_py.convert import (
    message_to_csv as message_to_csv,
    message_to_ordereddict as message_to_ordereddict,
    message_to_yaml as message_to_yaml,
)
from rosidl_runtime_py.get_interfaces import (
    get_action_interfaces as get_action_interfaces,
    get_interface_packages as get_interface_packages,
    get_interfaces as get_interfaces,
    get_message_interfaces as get_message_interfaces,
    get_service_interfaces as get_service_interfaces,
)
from rosidl_runtime_py.set_message import set_message_fields as set_message_fields
