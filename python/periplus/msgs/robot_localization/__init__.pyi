from periplus.msgs.robot_localization import srv as srv

__all__ = ["srv"]
