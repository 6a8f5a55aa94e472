from periplus.msgs.slam_toolbox import srv as srv

__all__ = ["srv"]
