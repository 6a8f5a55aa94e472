// A client of npm's @foxglove/ws-protocol: does what a viewer does, and says what came of it, one
// JSON object a line.
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { WebSocket } = require("ws");

const say = (what, more) => console.log(JSON.stringify({ what, ...more }));
const client = new FoxgloveClient({
  ws: new WebSocket(process.argv[2], [FoxgloveClient.SUPPORTED_SUBPROTOCOL]),
});
const hex = (view) => Buffer.from(view.buffer, view.byteOffset, view.byteLength).toString("hex");
const topics = new Map();

client.on("error", (error) => say("error", { message: String(error) }));
client.on("serverInfo", (info) => say("serverInfo", { info }));
client.on("status", (status) => say("status", { status }));
client.on("time", ({ timestamp }) => say("time", { timestamp: String(timestamp) }));
client.on("advertise", (channels) => {
  for (const channel of channels) {
    if (channel.topic === "/words") {
      topics.set(client.subscribe(channel.id), channel.topic);
      say("channel", { channel });
    }
  }
});
client.on("unadvertise", (ids) => say("unadvertise", { ids }));
client.on("message", ({ subscriptionId, timestamp, data }) => {
  say("message", { topic: topics.get(subscriptionId), timestamp: String(timestamp), data: hex(data) });
});
client.on("advertiseServices", (services) => {
  const lamp = services.find((service) => service.name === "/lamp");
  if (lamp == undefined) {
    return;
  }
  say("service", { service: lamp });
  // std_srvs/srv/SetBool_Request with `data: true`.
  const data = new DataView(new Uint8Array([0, 1, 0, 0, 1]).buffer);
  client.sendServiceCallRequest({ serviceId: lamp.id, callId: 7, encoding: "cdr", data });
  client.sendServiceCallRequest({ serviceId: 4000000, callId: 8, encoding: "cdr", data });
});
client.on("serviceCallResponse", (response) => {
  say("answer", { callId: response.callId, encoding: response.encoding, data: hex(response.data) });
});
client.on("serviceCallFailure", (failure) => say("failure", failure));
client.on("parameterValues", ({ parameters, id }) => say("parameters", { parameters, id }));
client.on("connectionGraphUpdate", (update) => say("graph", { update }));
client.on("fetchAssetResponse", (response) => {
  const data = response.data == undefined ? null : hex(response.data);
  say("asset", { requestId: response.requestId, status: response.status, data });
});
client.on("open", () => {
  const id = client.advertise({
    topic: "/answers",
    encoding: "cdr",
    schemaName: "std_msgs/msg/String",
  });
  // "yes", as CDR.
  client.sendMessage(id, new Uint8Array([0, 1, 0, 0, 4, 0, 0, 0, 121, 101, 115, 0]));
  client.getParameters([], "all");
  client.subscribeConnectionGraph();
  client.fetchAsset("package://arm/hand.stl", 5);
});
process.stdin.on("end", () => process.exit(0));
process.stdin.resume();
