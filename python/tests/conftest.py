"""Settings of all tests."""

import signal

from hypothesis import HealthCheck, settings

# A shell lets programs in the background ignore Ctrl-C, and they hand that on to the programs that they start.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# The same examples in every run, without limits of time, which fail on a busy machine.
settings.register_profile(
    "periplus", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("periplus")
