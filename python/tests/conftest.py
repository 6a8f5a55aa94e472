"""Settings of all tests."""

from hypothesis import HealthCheck, settings

# The same examples in every run, without limits of time, which fail on a busy machine.
settings.register_profile(
    "periplus", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("periplus")
