"""Whether the messages of a topic are stamped at a rate: rate.py TOPIC HZ."""
import json
import subprocess
import sys

topic, rate = sys.argv[1], float(sys.argv[2])
echo = ["periplus", "topic", "echo", topic, "--json", "--no-arr", "--timeout", "30"]
with subprocess.Popen(echo, stdout=subprocess.PIPE, text=True) as process:
    stamps = []
    for line in process.stdout:
        stamp = json.loads(line)["header"]["stamp"]
        stamps.append(stamp["sec"] + stamp["nanosec"] * 1e-9)
        if len(stamps) == 8:
            break
    process.kill()
# Of a slow machine some are missing, so the shortest interval counts.
intervals = [later - earlier for earlier, later in zip(stamps, stamps[1:])]
assert intervals, f"no messages on {topic}"
print(topic, intervals)
assert abs(min(intervals) * rate - 1) < 0.05, f"{topic} has {1 / min(intervals)} Hz, not {rate}"
