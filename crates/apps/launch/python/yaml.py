"""Reads and writes YAML where PyYAML is not installed."""
import json

from periplus_launch import conversation


class YAMLError(Exception):
    """Invalid YAML."""


class Loader:
    """The one way in which texts are read."""


class Dumper:
    """The one way in which values are written."""


BaseLoader = SafeLoader = FullLoader = UnsafeLoader = CLoader = CSafeLoader = Loader
SafeDumper = CDumper = CSafeDumper = Dumper


def load(stream, Loader=None):
    text = stream.read() if hasattr(stream, "read") else stream
    if isinstance(text, bytes):
        text = text.decode("utf-8")
    try:
        return conversation.ask("yaml", text=text)
    except conversation.Refused as refused:
        raise YAMLError(str(refused)) from None


safe_load = full_load = unsafe_load = load


def load_all(stream, Loader=None):
    yield load(stream)


safe_load_all = load_all


def dump(data, stream=None, Dumper=None, **_options):
    # JSON is YAML.
    text = json.dumps(data, indent=2, default=str) + "\n"
    if stream is None:
        return text
    stream.write(text)
    return None


safe_dump = dump
