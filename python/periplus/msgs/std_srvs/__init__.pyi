from periplus.msgs.std_srvs import srv as srv

__all__ = ["srv"]
