"""Folders of packages in source trees."""

from pathlib import Path

import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

from ament_index_python.packages import (  # noqa: E402
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
    get_package_share_path,
)


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "src" / "bot_bringup"
    (folder / "launch").mkdir(parents=True)
    (folder / "launch" / "bot.launch.py").write_text("")
    (folder / "package.xml").write_text("<package format='3'><name>bot_bringup</name></package>")
    monkeypatch.setenv("PERIPLUS_PACKAGES", str(tmp_path / "src"))
    return folder


def test_share_is_the_source_folder(tree: Path) -> None:
    assert get_package_share_directory("bot_bringup") == str(tree)
    assert (get_package_share_path("bot_bringup") / "launch" / "bot.launch.py").is_file()
    assert get_package_prefix("bot_bringup") == str(tree.parent)


def test_missing_package_is_a_key_error_with_a_hint(tree: Path) -> None:
    with pytest.raises(KeyError) as error:
        get_package_share_directory("bot_bring_up")
    assert isinstance(error.value, PackageNotFoundError)
    assert "package 'bot_bring_up' not found" in str(error.value) and "Did you mean 'bot_bringup'?" in str(error.value)


def test_installed_packages_are_found(tree: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    prefix = tmp_path / "install"
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "other").write_text("")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    assert get_package_share_directory("other") == str(prefix / "share" / "other")
