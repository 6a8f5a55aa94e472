"""A program that knows nothing of Periplus: PyPI's eclipse-zenoh, which does what rmw_zenoh's design
document says, with CDR of its own. It says on its output what it saw, a line each.

  zenoh_peer PORT router
  zenoh_peer PORT tokens COUNT             who is there, when there are so many
  zenoh_peer PORT sub    TOPIC COUNT [latched]
  zenoh_peer PORT hear   TOPIC COUNT       of whatever type
  zenoh_peer PORT pub    TOPIC COUNT [latched]
  zenoh_peer PORT serve  SERVICE COUNT     std_srvs/srv/Trigger
  zenoh_peer PORT call   SERVICE COUNT
"""

import queue
import struct
import sys
import time

import xxhash
import zenoh
import zenoh.ext

STRING = "std_msgs::msg::dds_::String_/RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
TRIGGER = "std_srvs::srv::dds_::Trigger_/RIHS01_eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f"


def opened(port, is_router):
    config = zenoh.Config()
    here = f"127.0.0.1:{port}"
    settings = {"scouting/multicast/enabled": "false", "timestamping/enabled": "true"}
    if is_router:
        settings |= {"mode": '"router"', "listen/endpoints": f'["tcp/{here}"]'}
    else:
        settings |= {"mode": '"peer"', "listen/endpoints": '["tcp/127.0.0.1:0"]', "connect/endpoints": f'["tcp/{here}"]'}
    for path, value in settings.items():
        config.insert_json5(path, value)
    return zenoh.open(config)


def text_of(cdr):
    """A string as CDR: four bytes that say how it is coded, its length, itself, a zero."""
    assert cdr[:4] == b"\0\1\0\0", cdr
    (length,) = struct.unpack_from("<I", cdr, 4)
    assert len(cdr) >= 8 + length and cdr[7 + length] == 0, cdr
    return cdr[8 : 7 + length].decode()


def cdr_of(text):
    return b"\0\1\0\0" + struct.pack("<I", len(text) + 1) + text.encode() + b"\0"


def gid_of(token):
    sums = xxhash.xxh3_128(token.encode())
    value = sums.intdigest()
    return struct.pack("<QQ", value & (2**64 - 1), value >> 64)


def beside(number, gid):
    return struct.pack("<qqB", number, time.time_ns(), 16) + gid


def read_beside(attachment):
    assert len(attachment) == 33 and attachment[16] == 16, attachment
    number, sent = struct.unpack_from("<qq", attachment)
    assert abs(time.time_ns() - sent) < 60e9, sent
    return number, attachment[17:]


class Peer:
    def __init__(self, port):
        self.session = opened(port, False)
        self.id = str(self.session.info.zid())
        self.held = [self.session.liveliness().declare_token(f"@ros2_lv/0/{self.id}/0/0/NN/%/%/peer")]

    def token(self, kind, name, of, qos="::,10:,:,:,,"):
        key = f"@ros2_lv/0/{self.id}/0/{len(self.held)}/{kind}/%/%/peer/{name.replace('/', '%')}/{of}/{qos}"
        self.held.append(self.session.liveliness().declare_token(key))
        return gid_of(key)

    def others(self):
        replies = self.session.liveliness().get("@ros2_lv/0/**", timeout=2)
        keys = [str(reply.ok.key_expr) for reply in replies if reply.ok]
        return sorted(key for key in keys if f"/{self.id}/" not in key)

    def wait(self, kind, name):
        """Until somebody has this end; its keys."""
        while True:
            found = [key for key in self.others() if f"/{kind}/" in key and f"/{name.replace('/', '%')}/" in key]
            if found:
                return found
            time.sleep(0.02)


def main(words):
    port, verb = words[0], words[1]
    if verb == "router":
        session = opened(port, True)
        print("ready", flush=True)
        sys.stdin.readline()
        session.close()
        return
    peer = Peer(port)
    session = peer.session
    latched = words[-1] == "latched"
    qos = ":1:,1:,:,:,," if latched else "::,10:,:,:,,"
    if verb == "tokens":
        while len(peer.others()) < int(words[2]):
            time.sleep(0.02)
        for key in peer.others():
            parts = key.split("/")
            print(" ".join(parts[1:2] + parts[5:]), flush=True)
    elif verb == "sub":
        samples = queue.Queue()
        key = f"0{words[2]}/{STRING}"
        if latched:
            history = zenoh.ext.HistoryConfig(detect_late_publishers=True, max_samples=1)
            hearing = zenoh.ext.declare_advanced_subscriber(
                session, key, samples.put, history=history, subscriber_detection=True
            )
        else:
            hearing = session.declare_subscriber(key, samples.put)
        peer.token("MS", words[2], STRING, qos)
        publisher = gid_of(peer.wait("MP", words[2])[0])
        for _ in range(int(words[3])):
            sample = samples.get()
            number, gid = read_beside(bytes(sample.attachment))
            whose = "its" if gid == publisher else "NOT ITS"
            print(f"{text_of(bytes(sample.payload))} number {number}, {whose} name", flush=True)
        hearing.undeclare()
    elif verb == "hear":
        samples = queue.Queue()
        publisher = peer.wait("MP", words[2])[0]
        of, sums = publisher.split("/")[10:12]
        hearing = session.declare_subscriber(f"0{words[2]}/{of}/{sums}", samples.put)
        for _ in range(int(words[3])):
            sample = samples.get()
            _, gid = read_beside(bytes(sample.attachment))
            whose = "its" if gid == gid_of(publisher) else "NOT ITS"
            print(f"{of} of {len(bytes(sample.payload))} bytes, {whose} name", flush=True)
        hearing.undeclare()
    elif verb == "pub":
        key = f"0{words[2]}/{STRING}"
        if latched:
            cache = zenoh.ext.CacheConfig(max_samples=1)
            saying = zenoh.ext.declare_advanced_publisher(session, key, cache=cache, publisher_detection=True)
        else:
            saying = session.declare_publisher(key)
        gid = peer.token("MP", words[2], STRING, qos)
        if not latched:
            peer.wait("MS", words[2])
            while not saying.matching_status.matching:
                time.sleep(0.01)
        for number in range(1, int(words[3]) + 1):
            saying.put(cdr_of(f"from zenoh {number}"), attachment=beside(number, gid))
        print("done", flush=True)
        sys.stdin.readline()
    elif verb == "serve":
        questions = queue.Queue()
        key = f"0{words[2]}/{TRIGGER}"
        serving = session.declare_queryable(key, questions.put, complete=True)
        peer.token("SS", words[2], TRIGGER)
        asking = gid_of(peer.wait("SC", words[2])[0])
        for left in range(int(words[3])):
            question = questions.get()
            number, gid = read_beside(bytes(question.attachment))
            body = bytes(question.payload)
            whose = "its" if gid == asking and number == left + 1 else "NOT ITS"
            print(f"asked with {len(body)} bytes, {whose} name and number", flush=True)
            question.reply(key, b"\0\1\0\0\1\0\0\0" + cdr_of("from zenoh")[4:], attachment=beside(number, gid))
            question.drop()
        print("done", flush=True)
        sys.stdin.readline()
        serving.undeclare()
    elif verb == "call":
        key = f"0{words[2]}/{TRIGGER}"
        gid = peer.token("SC", words[2], TRIGGER)
        peer.wait("SS", words[2])
        for number in range(7, 7 + int(words[3])):
            replies = session.get(
                key,
                payload=b"\0\1\0\0\0",
                attachment=beside(number, gid),
                target=zenoh.QueryTarget.ALL_COMPLETE,
                consolidation=zenoh.ConsolidationMode.NONE,
                timeout=30,
            )
            answers = [reply.ok for reply in replies]
            assert len(answers) == 1 and answers[0], answers
            answer = bytes(answers[0].payload)
            mine = "mine" if read_beside(bytes(answers[0].attachment)) == (number, gid) else "NOT MINE"
            print(f"answer {answer[4]} {text_of(answer[:4] + answer[8:])}, {mine}", flush=True)
    session.close()


main(sys.argv[1:])
