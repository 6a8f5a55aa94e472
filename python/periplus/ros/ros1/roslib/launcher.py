"""Setup of the path of a package."""


def load_manifest(package_name: str, bootstrap_version: str = "0.6") -> None:
    """Does nothing: the packages of the source tree are on the path already."""
