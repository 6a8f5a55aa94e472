"""Makes oracle.jsonl and hashes.tsv: what others make of the same messages.

    python3 -m venv venv && venv/bin/pip install rosbags==0.11.9 numpy
    venv/bin/pip download --no-deps -d wheels ros-action-msgs==2.0.3 ros-builtin-interfaces==2.0.3 \
        ros-diagnostic-msgs==5.3.6 ros-geometry-msgs==5.3.6 ros-lifecycle-msgs==2.0.3 \
        ros-nav-msgs==5.3.6 ros-rcl-interfaces==2.0.3 ros-rosgraph-msgs==2.0.3 \
        ros-sensor-msgs==5.3.6 ros-service-msgs==2.0.3 ros-shape-msgs==5.3.6 ros-std-msgs==5.3.6 \
        ros-std-srvs==5.3.6 ros-trajectory-msgs==5.3.6 ros-type-description-interfaces==2.0.3 \
        ros-unique-identifier-msgs==2.5.0 ros-visualization-msgs==5.3.6 ros-actionlib-msgs==5.5.1
    venv/bin/python make.py wheels

oracle.jsonl: for every message of ours that rosbags can serialize, random values as JSON and the
bytes of rosbags (LE, BE: CDR; ROS 1) in base64. rosbags reads our texts, so this judges the codec,
not the texts.

hashes.tsv: type hashes, and who says so. `jazzy` is the build of ROS 2 Jazzy that the wheels on PyPI
hold (`share/<package>/*/<Name>.json`, written by rosidl); `rosbags-jazzy` is the type as rosbags
knows it; `rosbags` is its calculation over our text, which judges our calculation, not the text.

variants.tsv: the hashes of `rosbags` for the types that have another form in another distribution.

published.tsv is not made here: its hashes were read one by one, `running` off `ros2 topic info -v` of
a ROS 2 Jazzy, `rosidl` off code that rosidl made (`*__description.c`) in public workspaces.
"""

import base64
import glob
import json
import math
import random
import sys
import zipfile
from pathlib import Path

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

HERE = Path(__file__).parent
RANDOM = random.Random(7)
# rosbags hashes these otherwise than rosidl does.
KNOWN_WRONG = {'std_msgs/msg/Char', 'service_msgs/msg/ServiceEventInfo'}


def texts(folder):
    folder = HERE.parent.parent / folder
    for path in sorted(folder.glob('*/*/*')):
        package, kind, file = path.relative_to(folder).parts
        name = file.split('.')[0]
        parts = []
        part = []
        for line in path.read_text().split('\n'):
            if line.strip() == '---':
                parts.append('\n'.join(part))
                part = []
            else:
                part.append(line)
        parts.append('\n'.join(part))
        suffixes = {
            'msg': [''],
            'srv': ['_Request', '_Response'],
            'action': ['_Goal', '_Result', '_Feedback'],
        }[kind]
        for suffix, text in zip(suffixes, parts, strict=True):
            yield f'{package}/{kind}/{name}{suffix}', text


def whole(kind):
    bits = int(kind.strip('uint'))
    least = 0 if kind.startswith('u') else -(1 << (bits - 1))
    return RANDOM.choice([least, least + (1 << bits) - 1, RANDOM.randrange(least, least + (1 << bits))])


def number(kind):
    if kind == 'bool':
        return RANDOM.random() < 0.5
    if kind.startswith('float'):
        if RANDOM.random() < 0.03:
            return RANDOM.choice([math.nan, math.inf, -math.inf])
        return RANDOM.randrange(-40, 40) / 4
    if kind in {'byte', 'octet'}:
        # rosbags holds a byte for signed; below 128 that is the same.
        return RANDOM.randrange(0, 128)
    return whole({'byte': 'uint8', 'octet': 'uint8', 'char': 'uint8'}.get(kind, kind))


def text():
    return RANDOM.choice(['', 'a', 'map', 'base_link', 'é→😀', "it's"])


def value(store, kind, what):
    """A random value, and the same as JSON."""
    if kind == Nodetype.BASE:
        name = what[0]
        made = text() if name == 'string' else number(name)
        return made, plain(made)
    if kind == Nodetype.NAME:
        return message(store, what)
    element, size = what
    count = size if kind == Nodetype.ARRAY else RANDOM.randrange(0, min(size, 3) + 1 if size else 4)
    pairs = [value(store, *element) for _ in range(count)]
    made = [one for one, _ in pairs]
    if element[0] == Nodetype.BASE and element[1][0] != 'string':
        name = {'octet': 'uint8', 'byte': 'uint8', 'char': 'uint8'}.get(element[1][0], element[1][0])
        made = np.array(made, dtype=name)
    return made, [one for _, one in pairs]


def plain(made):
    if isinstance(made, float) and not math.isfinite(made):
        return 'NaN' if math.isnan(made) else 'Infinity' if made > 0 else '-Infinity'
    return made


def message(store, name):
    fields = [one for one in store.fielddefs[name][1]]
    pairs = {field: value(store, *what) for field, what in fields}
    made = store.types[name](**{field: one for field, (one, _) in pairs.items()})
    hidden = 'structure_needs_at_least_one_member'
    if hidden in pairs:
        setattr(made, hidden, 0)
        pairs = {}
    return made, {field: one for field, (_, one) in pairs.items()}


def read(folder):
    types = {}
    for name, source in texts(folder):
        # rosbags knows messages only, and takes the folder for a part of the package.
        package, _, short = name.split('/')
        (made,) = get_types_from_msg(source, f'{package}/msg/{short}').values()
        types[name] = made
    return types


def main():
    store = get_typestore(Stores.EMPTY)
    types = read('interfaces')
    store.register(types)

    def base(raw):
        return base64.b64encode(bytes(raw)).decode()

    with (HERE / 'oracle.jsonl').open('w') as out:
        for name in sorted(types):
            made, as_json = message(store, name)
            line = {
                'type': name,
                'json': as_json,
                'le': base(store.serialize_cdr(made, name, little_endian=True)),
                'be': base(store.serialize_cdr(made, name, little_endian=False)),
                'ros1': base(store.cdr_to_ros1(store.serialize_cdr(made, name), name)),
            }
            out.write(json.dumps(line, separators=(',', ':')) + '\n')

    hashes = {name: (store.hash_rihs01(name), 'rosbags') for name in types if name not in KNOWN_WRONG}
    jazzy = get_typestore(Stores.ROS2_JAZZY)
    for name in set(jazzy.fielddefs) & set(types) - KNOWN_WRONG:
        hashes[name] = (jazzy.hash_rihs01(name), 'rosbags-jazzy')
    for wheel in glob.glob(f'{sys.argv[1]}/*.whl'):
        with zipfile.ZipFile(wheel) as archive:
            for name in archive.namelist():
                if '/share/' in name and name.endswith('.json'):
                    content = json.loads(archive.read(name))
                    for one in content.get('type_hashes', []):
                        hashes[one['type_name']] = (one['hash_string'], 'jazzy')
    packages = {name.split('/')[0] for name in types}
    with (HERE / 'hashes.tsv').open('w') as out:
        for name in sorted(hashes):
            if name.split('/')[0] in packages:
                out.write('\t'.join([name, *hashes[name]]) + '\n')
    with (HERE / 'variants.tsv').open('w') as out:
        for release in ('humble', 'main'):
            forms = read(f'interfaces_{release}')
            store = get_typestore(Stores.EMPTY)
            store.register({**types, **forms})
            for name in sorted(forms):
                out.write('\t'.join([release, name, store.hash_rihs01(name)]) + '\n')


main()
