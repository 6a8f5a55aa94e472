"""Reading and writing of recordings."""

from rosbag2_py._info import Info as Info, MetadataIo as MetadataIo
from rosbag2_py._options import (
    BagMetadata as BagMetadata,
    ConverterOptions as ConverterOptions,
    FileInformation as FileInformation,
    MessageDefinition as MessageDefinition,
    ReadOrder as ReadOrder,
    ReadOrderSortBy as ReadOrderSortBy,
    StorageFilter as StorageFilter,
    StorageOptions as StorageOptions,
    TopicInformation as TopicInformation,
    TopicMetadata as TopicMetadata,
)
from rosbag2_py._reader import SequentialCompressionReader as SequentialCompressionReader, SequentialReader as SequentialReader
from rosbag2_py._writer import (
    CompressionMode as CompressionMode,
    CompressionOptions as CompressionOptions,
    SequentialCompressionWriter as SequentialCompressionWriter,
    SequentialWriter as SequentialWriter,
)


def get_default_storage_id() -> str:
    """Format of new recordings."""
    return "mcap"


def get_registered_readers() -> set[str]:
    """Formats that can be read."""
    return {"mcap", "sqlite3"}


def get_registered_writers() -> set[str]:
    """Formats that can be written."""
    return {"mcap", "sqlite3"}


def get_registered_serializers() -> set[str]:
    """Serialization formats."""
    return {"cdr"}


def get_registered_compressors() -> set[str]:
    """Compression formats."""
    return {"lz4", "zstd"}
