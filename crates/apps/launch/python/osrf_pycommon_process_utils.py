"""Helpers that launch files import."""
import shutil


def which(cmd, mode=None, path=None, **_options):
    return shutil.which(cmd, path=path)


def get_loop():
    import asyncio

    return asyncio.new_event_loop()
