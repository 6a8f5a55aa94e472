import { expect, test, vi } from 'vitest';
import { FoxgloveServer } from '@foxglove/ws-protocol';
import { WebSocketServer, WebSocket } from 'ws';
import { encoder } from '../src/core/cdr';
import { Client, type Socket } from '../src/core/client';
import type { Mismatch, Parameter } from '../src/core/protocol';
import { parseSchema } from '../src/core/schema';

/** Reference server of the protocol. */
async function peer() {
  const server = new FoxgloveServer({
    name: 'peer',
    capabilities: ['clientPublish', 'parameters', 'services', 'connectionGraph', 'assets'] as never,
    supportedEncodings: ['cdr'],
  });
  const sockets = new WebSocketServer({
    port: 0,
    handleProtocols: (wanted) => server.handleProtocols(wanted),
  });
  sockets.on('connection', (socket, request) =>
    server.handleConnection(socket as never, request.socket.remoteAddress ?? ''),
  );
  await new Promise((resolve) => sockets.once('listening', resolve));
  const { port } = sockets.address() as { port: number };
  return { server, sockets, url: `ws://127.0.0.1:${port}` };
}

function clientOf(url: string, events: Partial<ConstructorParameters<typeof Client>[1]> = {}) {
  const nothing = () => undefined;
  return new Client(
    () => new WebSocket(url, ['foxglove.websocket.v1']) as unknown as Socket,
    {
      state: nothing,
      graphChanged: nothing,
      parameters: nothing,
      time: nothing,
      status: nothing,
      ...events,
    },
    { 'std_msgs/msg/String': 'string data' },
  );
}

const text = { topic: '/chatter', encoding: 'cdr', schemaName: 'std_msgs/msg/String' };

test('subscribes once a topic is advertised, and only while it has a handler', async () => {
  const { server, sockets, url } = await peer();
  const subscribed = vi.fn();
  const unsubscribed = vi.fn();
  server.on('subscribe', subscribed);
  server.on('unsubscribe', unsubscribed);
  const client = clientOf(url);
  const heard: unknown[] = [];
  const leave = client.subscribe('/chatter', (message) => heard.push(message.data));
  client.start();
  await vi.waitFor(() => expect(client.state).toBe('open'));
  const channel = server.addChannel({ ...text, schema: 'string data', schemaEncoding: 'ros2msg' });
  await vi.waitFor(() => expect(subscribed).toHaveBeenCalledTimes(1));
  const encode = encoder(parseSchema('std_msgs/msg/String', 'string data'));
  server.sendMessage(channel, 5n, new Uint8Array(encode({ data: 'hello' })));
  await vi.waitFor(() => expect(heard).toEqual(['hello']));
  leave();
  await vi.waitFor(() => expect(unsubscribed).toHaveBeenCalledTimes(1));
  client.stop();
  sockets.close();
});

test('a later handler receives the last message of a latched topic', async () => {
  const { server, sockets, url } = await peer();
  const encode = encoder(parseSchema('std_msgs/msg/String', 'string data'));
  const schema = { schema: 'string data', schemaEncoding: 'ros2msg' };
  const channel = server.addChannel({ ...text, ...schema });
  // A latched topic: each new subscription gets the last message.
  server.on('subscribe', () =>
    server.sendMessage(channel, 5n, new Uint8Array(encode({ data: 'map' }))),
  );
  const client = clientOf(url);
  const heard: string[] = [];
  client.start();
  await vi.waitFor(() => expect(client.channels.size).toBe(1));
  client.subscribe('/chatter', () => heard.push('first'));
  await vi.waitFor(() => expect(heard).toEqual(['first']));
  client.subscribe('/chatter', () => heard.push('second'));
  await vi.waitFor(() => expect(heard).toContain('second'));
  client.stop();
  sockets.close();
});

test('publishes, calls services, reads and sets parameters', async () => {
  const { server, sockets, url } = await peer();
  const said: string[] = [];
  server.on('message', (event) => {
    // After the header of the message and the length of the string.
    const { data } = event as never as { data: Uint8Array };
    said.push(String.fromCharCode(...data.subarray(8, 10)));
  });
  server.on('getParameters', (_request, connection) => {
    server.publishParameterValues([{ name: 'node.speed', value: 0.5 }], undefined, connection);
  });
  const set = vi.fn();
  server.on('setParameters', (request) => set(request.parameters));
  server.on('serviceCallRequest', (request, connection) => {
    const encode = encoder(parseSchema('x', 'bool success\nstring message'));
    const data = new Uint8Array(encode({ success: true, message: 'done' }));
    server.sendServiceCallResponse(
      {
        serviceId: request.serviceId,
        callId: request.callId,
        encoding: 'cdr',
        data: new DataView(data.buffer, data.byteOffset, data.byteLength),
      },
      connection,
    );
  });
  server.addService({
    name: '/trigger',
    type: 'std_srvs/srv/Trigger',
    requestSchema: '',
    responseSchema: 'bool success\nstring message',
  });
  let parameters: Parameter[] = [];
  const client = clientOf(url, { parameters: (all) => (parameters = all) });
  const say = client.publisher('/said', 'std_msgs/msg/String');
  client.start();
  await vi.waitFor(() => expect(client.services.has('/trigger')).toBe(true));
  expect(await client.call('/trigger', {})).toEqual({ success: true, message: 'done' });
  await vi.waitFor(() => expect(parameters).toEqual([{ name: 'node.speed', value: 0.5 }]));
  client.setParameter({ name: 'node.speed', value: 0.75 });
  await vi.waitFor(() => expect(set).toHaveBeenCalledWith([{ name: 'node.speed', value: 0.75 }]));
  say({ data: 'hi' });
  await vi.waitFor(() => expect(said).toEqual(['hi']));
  await expect(client.call('/nowhere', {})).rejects.toThrow('no node provides the service');
  client.stop();
  sockets.close();
});

test('reconnects after the server was down, and renews its subscriptions', async () => {
  const first = await peer();
  let url = first.url;
  const nothing = () => undefined;
  const client = new Client(
    () => new WebSocket(url, ['foxglove.websocket.v1']) as unknown as Socket,
    { state: nothing, graphChanged: nothing, parameters: nothing, time: nothing, status: nothing },
  );
  client.subscribe('/chatter', nothing);
  client.start();
  await vi.waitFor(() => expect(client.state).toBe('open'));
  for (const socket of first.sockets.clients) socket.terminate();
  first.sockets.close();
  const second = await peer();
  url = second.url;
  const subscribed = vi.fn();
  second.server.on('subscribe', subscribed);
  second.server.addChannel({ ...text, schema: 'string data', schemaEncoding: 'ros2msg' });
  await vi.waitFor(() => expect(subscribed).toHaveBeenCalled(), { timeout: 5000 });
  client.stop();
  second.sockets.close();
});

test('reports incompatible endpoints, and requests their repair', async () => {
  const sockets = new WebSocketServer({ port: 0 });
  await new Promise((resolve) => sockets.once('listening', resolve));
  const mismatch: Mismatch = {
    topic: '/map',
    publisher: { node: '/map_server', isOurs: false },
    subscription: { node: '/planner', isOurs: true },
    policies: [{ policy: 'durability', offered: 'volatile', asked: 'transient_local' }],
    repair: 'subscription',
    advice: 'let `/planner` ask for durability volatile',
  };
  const update = {
    op: 'connectionGraphUpdate',
    ...{ publishedTopics: [], subscribedTopics: [], advertisedServices: [] },
    ...{ removedTopics: [], removedServices: [] },
  };
  sockets.on('connection', (socket) => {
    socket.send(JSON.stringify({ ...update, mismatches: [mismatch] }));
    let asked = 0;
    socket.on('message', (data) => {
      const { op, id, topic, publisher, subscription } = JSON.parse(String(data));
      if (op !== 'repairQos') return;
      expect([topic, publisher, subscription]).toEqual(['/map', '/map_server', '/planner']);
      const isRepaired = asked++ === 0;
      const message = isRepaired ? 'it fits now' : 'there is no such mismatch';
      socket.send(JSON.stringify({ op: 'repairQosResult', id, isRepaired, message }));
      socket.send(JSON.stringify({ ...update, mismatches: [] }));
    });
  });
  const client = clientOf(`ws://127.0.0.1:${(sockets.address() as { port: number }).port}`);
  client.start();
  await vi.waitFor(() => expect(client.mismatches).toEqual([mismatch]));
  expect(await client.repair(mismatch)).toBe('it fits now');
  await vi.waitFor(() => expect(client.mismatches).toEqual([]));
  await expect(client.repair(mismatch)).rejects.toThrow('no such mismatch');
  client.stop();
  sockets.close();
});
