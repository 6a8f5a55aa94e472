"""Types and names of ROS 2 as rmw_cyclonedds has them, of PyPI's cyclonedds alone."""

import types
from dataclasses import dataclass

from cyclonedds.core import Policy, Qos
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.annotations import final
from cyclonedds.idl.types import array, int32, int64, sequence, uint8, uint32, uint64
from cyclonedds.util import duration


def struct(typename, /, **fields):
    """A type of ROS: its name as DDS has it, and its fields."""
    name = typename.rsplit("::", 1)[-1]
    body = {"__annotations__": fields or {"structure_needs_at_least_one_member": uint8}, "__module__": __name__}
    made = types.new_class(name, (IdlStruct,), {"typename": typename}, lambda space: space.update(body))
    return dataclass(final(made))


def message(name, /, **fields):
    package, name = name.split("/")
    return struct(f"{package}::msg::dds_::{name}_", **fields)


def service(name, request, response, kind="srv"):
    """Both types of a service, with the caller's name and number in front as rmw_cyclonedds has them."""
    package, name = name.split("/")
    header = {"caller": uint64, "number": int64}
    ends = (("Request", request), ("Response", response))
    return [
        struct(f"{package}::{kind}::dds_::{name}_{end}_", **header, **(fields or {"nothing": uint8}))
        for end, fields in ends
    ]


def qos(latched=False, depth=100, reliable=True):
    return Qos(
        Policy.Reliability.Reliable(duration(seconds=2)) if reliable else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if latched else Policy.Durability.Volatile,
        Policy.History.KeepLast(depth),
        Policy.DataRepresentation(use_cdrv0_representation=True, use_xcdrv2_representation=False),
    )


Time = message("builtin_interfaces/Time", sec=int32, nanosec=uint32)

# Who has which endpoints: rmw_dds_common, as since Iron.
Gid = message("rmw_dds_common/Gid", data=array[uint8, 16])
NodeEntities = message(
    "rmw_dds_common/NodeEntitiesInfo",
    node_namespace=str,
    node_name=str,
    reader_gid_seq=sequence[Gid],
    writer_gid_seq=sequence[Gid],
)
Entities = message(
    "rmw_dds_common/ParticipantEntitiesInfo", gid=Gid, node_entities_info_seq=sequence[NodeEntities]
)
