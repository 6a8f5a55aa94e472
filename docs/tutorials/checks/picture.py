"""How many pixels of an image are of a colour: picture.py TOPIC red|blue SHARE."""
import base64
import json
import subprocess
import sys

topic, colour, share = sys.argv[1], sys.argv[2], float(sys.argv[3])
echo = ["periplus", "topic", "echo", topic, "--once", "--json", "--full-length", "--timeout", "30"]
image = json.loads(subprocess.run(echo, check=True, capture_output=True, text=True).stdout)
data = image["data"]
data = base64.b64decode(data) if isinstance(data, str) else bytes(data)
assert image["encoding"] == "rgb8", image["encoding"]
first, last = (0, 2) if colour == "red" else (2, 0)
hits = sum(
    data[at + first] > 60 and data[at + first] > 1.5 * data[at + last] for at in range(0, len(data), 3)
)
found = hits / (len(data) / 3)
print(topic, colour, found)
assert found > share, f"{found} of {topic} is {colour}, not {share}"
