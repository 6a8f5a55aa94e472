import { describe, expect, test } from 'vitest';
import { whyStanding, type Standing } from '../src/app/standing';
import { suggestionFor } from '../src/app/auto';
import { decoder, encoder, type Message } from '../src/core/cdr';
import {
  goalRequest,
  isActive,
  namespacesOf,
  newestGoal,
  positionText,
  poseText,
  readStatus,
  refusalText,
  resultError,
  TreeLog,
} from '../src/core/nav2';
import { parseSchema } from '../src/core/schema';

describe('goals', () => {
  const goal = (byte: number, sec: number, status: number) => ({
    goal_info: { goal_id: { uuid: new Uint8Array(16).fill(byte) }, stamp: { sec, nanosec: 0 } },
    status,
  });
  const newest = (nowS: number, ...status_list: object[]) =>
    newestGoal({ status_list } as unknown as Message, nowS)?.uuid[0];

  test('the newest goal is that which was accepted last', () => {
    expect(newest(9)).toBeUndefined();
    expect(newest(9, goal(1, 5, 4), goal(2, 3, 4))).toBe(1);
  });

  test('a goal that is not over comes before all others', () => {
    expect(newest(9, goal(1, 5, 4), goal(2, 3, 2))).toBe(2);
  });

  test('goals from before a reset of the simulation do not hide the newest one', () => {
    expect(newest(4, goal(1, 50, 4), goal(2, 3, 4))).toBe(2);
    expect(newest(4, goal(1, 50, 4))).toBe(1);
  });

  test('accepted, executing and canceling goals are active', () => {
    const states = [0, 1, 2, 3, 4, 5, 6];
    const active = states.filter((state) =>
      isActive(newestGoal({ status_list: [goal(1, 1, state)] } as unknown as Message, 9)),
    );
    expect(active).toEqual([1, 2, 3]);
    expect(isActive(undefined)).toBe(false);
  });

  test('namespaces are those of the actions', () => {
    const names = ['/navigate_to_pose/_action/status', '/a/follow_waypoints/_action/send_goal'];
    expect(namespacesOf([...names, '/b/spin/_action/status', '/plan'])).toEqual(['', '/a']);
  });
});

describe('requests', () => {
  const TYPES =
    '===\nMSG: unique_identifier_msgs/UUID\nuint8[16] uuid\n' +
    '===\nMSG: geometry_msgs/PoseStamped\nstd_msgs/Header header\nPose pose\n' +
    '===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n' +
    '===\nMSG: geometry_msgs/Pose\nPoint position\n' +
    '===\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\n' +
    '===\nMSG: nav_msgs/Goals\nstd_msgs/Header header\ngeometry_msgs/PoseStamped[] goals\n';
  const pose = (x: number) =>
    ({ frame: 'map', pose: { position: { x, y: 0, z: 0 } } }) as unknown as Parameters<
      typeof goalRequest
    >[2][number];
  /** Goal that a server reads from the request, by the definition of the goal. */
  const received = (definition: string, xs: number[]) => {
    const text =
      `unique_identifier_msgs/UUID goal_id\nGoal goal\n===\nMSG: nav2_msgs/Goal\n${definition}\n` +
      TYPES;
    const schema = parseSchema('nav2_msgs/action/X_SendGoal_Request', text);
    const message = goalRequest(schema, new Uint8Array(16).fill(7), xs.map(pose));
    const read = decoder(schema)(encoder(schema)(message));
    expect((read.goal_id as { uuid: Uint8Array }).uuid).toEqual(new Uint8Array(16).fill(7));
    return read.goal as unknown as Record<string, never>;
  };
  const xs = (poses: { header: { frame_id: string }; pose: { position: { x: number } } }[]) =>
    poses.map((one) => [one.header.frame_id, one.pose.position.x]);

  test('of one pose', () => {
    const goal = received('geometry_msgs/PoseStamped pose\nstring behavior_tree', [3]);
    expect(xs([goal.pose!])).toEqual([['map', 3]]);
  });

  test('of a list of poses', () => {
    const goal = received('uint32 number_of_loops\ngeometry_msgs/PoseStamped[] poses', [3, 4]);
    expect(xs(goal.poses!)).toEqual([
      ['map', 3],
      ['map', 4],
    ]);
  });

  test('of poses in a message with a header', () => {
    const goal = received('nav_msgs/Goals poses', [3, 4]);
    const { header, goals } = goal.poses! as { header: { frame_id: string }; goals: never };
    expect(header.frame_id).toBe('map');
    expect(xs(goals)).toEqual([
      ['map', 3],
      ['map', 4],
    ]);
  });
});

describe('poses in words', () => {
  const pose = (x: number, y: number, z: number, w: number) => ({
    position: { x, y, z: 0 },
    orientation: { x: 0, y: 0, z, w },
  });
  test('have no sign of zero', () => {
    expect(poseText(pose(1.2, -0.001, -0.001, 1))).toBe('1.20, 0.00 m, 0°');
    expect(positionText(pose(-1.2, -0.5, 0, 1))).toBe('-1.20, -0.50 m');
  });
  test('have a heading of at most half a turn', () => {
    const half = Math.SQRT1_2;
    expect(poseText(pose(0, 0, half, half))).toBe('0.00, 0.00 m, 90°');
    expect(poseText(pose(0, 0, half, -half))).toBe('0.00, 0.00 m, -90°');
  });
});

describe('types that an action implies', () => {
  const UUID = '===\nMSG: unique_identifier_msgs/UUID\nuint8[16] uuid\n';
  const fields = (name: string, rest: string) =>
    parseSchema(name, `\n${rest}`).root.fields.map((field) => `${field.type} ${field.name}`);

  test('have their definition if the server sends none', () => {
    const X = 'a_msgs/action/X';
    const id = 'unique_identifier_msgs/UUID goal_id';
    expect(fields(`${X}_SendGoal_Request`, UUID)).toEqual([id, 'a_msgs/X_Goal goal']);
    expect(fields(`${X}_SendGoal_Response`, '')).toEqual([
      'bool accepted',
      'builtin_interfaces/Time stamp',
    ]);
    expect(fields(`${X}_GetResult_Request`, UUID)).toEqual([id]);
    expect(fields(`${X}_GetResult_Response`, '')).toEqual([
      'int8 status',
      'a_msgs/X_Result result',
    ]);
    expect(fields(`${X}_FeedbackMessage`, UUID)).toEqual([id, 'a_msgs/X_Feedback feedback']);
  });

  test('and that of the server otherwise', () => {
    expect(fields('a_msgs/action/X_FeedbackMessage', 'uint8 y')).toEqual(['uint8 y']);
    expect(fields('std_msgs/msg/Empty', '')).toEqual([]);
  });
});

describe('status', () => {
  test('running nodes, recoveries and the last error', () => {
    const text =
      'navigate_to_pose: FollowPath, Wait (WaitABit) (2 recoveries); last error: compute_path_to_pose ' +
      'failed with code 208: the goal is blocked; see above';
    expect(readStatus(text)).toEqual({
      action: 'navigate_to_pose',
      running: ['FollowPath', 'Wait (WaitABit)'],
      recoveries: 2,
      lastError: 'compute_path_to_pose failed with code 208: the goal is blocked; see above',
      outcome: '',
    });
  });

  test('one recovery, and no running node', () => {
    const status = readStatus('navigate_to_pose: between two steps (1 recovery)');
    expect([status.running, status.recoveries]).toEqual([[], 1]);
  });

  test('the outcome of the last goal', () => {
    expect(readStatus('no goal').outcome).toBe('');
    expect(readStatus('no goal; Goal succeeded').outcome).toBe('Goal succeeded');
    expect(readStatus('no goal; Goal succeeded; last error: x').lastError).toBe('x');
  });

  test('an error has its message and its code', () => {
    const of = (result: Message) => resultError({ result } as unknown as Message);
    expect(of({ error_code: 208, error_msg: 'blocked' })).toBe('blocked (error code 208)');
    expect(of({ error_code: 208, error_msg: '' })).toBe('error code 208');
    expect(of({})).toBe('');
  });

  test('a refused goal has the reason from the log', () => {
    const logged = 'rejected a goal of `navigate_to_pose`: the server is inactive';
    expect(refusalText(logged)).toBe('The navigator refused the goal: the server is inactive');
    expect(refusalText('')).toMatch(/gave no reason/);
  });

  test('the log of the tree gives the running nodes', () => {
    const log = new TreeLog();
    const change = (node_name: string, uid: number, current_status: string) =>
      log.add({ event_log: [{ node_name, uid, current_status }] } as unknown as Message);
    change('Wait', 1, 'RUNNING');
    change('Wait', 2, 'RUNNING');
    change('Spin', 3, 'RUNNING');
    change('Wait', 1, 'SUCCESS');
    expect(log.names()).toEqual(['Wait', 'Spin']);
    log.clear();
    expect(log.names()).toEqual([]);
  });
});

describe('why the robot stands', () => {
  const DRIVING: Standing = {
    hasGoal: true,
    isPaused: false,
    stillS: 0,
    refusal: '',
    failure: '',
    lastError: '',
    stoppedBy: '',
    running: [],
  };
  const check = (change: Partial<Standing>, expected: string | RegExp) => {
    const text = whyStanding({ ...DRIVING, ...change });
    if (typeof expected === 'string') expect(text).toBe(expected);
    else expect(text).toMatch(expected);
  };

  test('it drives, or has nothing to do', () => {
    check({}, '');
    check({ stillS: 2.9 }, '');
    check({ hasGoal: false, stillS: 100 }, '');
  });

  test('the simulation is paused', () => check({ isPaused: true, lastError: 'x' }, /is paused/));
  test('the collision monitor stops it', () => check({ stoppedBy: 'PolygonStop' }, /PolygonStop/));
  test('a server failed', () => check({ lastError: 'no path' }, 'no path'));
  test('an old error is not the reason while the robot follows a path', () => {
    check({ lastError: 'no path', running: ['FollowPath'] }, '');
    check({ lastError: 'no path', running: ['FollowPath (Follow)'], stillS: 3 }, 'no path');
    check({ lastError: 'no path', running: ['Spin'] }, 'no path');
  });
  test('it does not move', () =>
    check({ stillS: 3, running: ['Wait'] }, 'The robot does not move; running: Wait.'));
  test('the goal failed', () => check({ hasGoal: false, failure: 'blocked' }, 'blocked'));
  test('the goal was refused', () =>
    check({ hasGoal: false, refusal: 'inactive', failure: 'x' }, 'inactive'));
  test('an old failure is not the reason while it drives', () => check({ failure: 'x' }, ''));
});

describe('displays of navigation', () => {
  const path = (topic: string) => suggestionFor(topic, 'nav_msgs/msg/Path');

  test('the plan and the local plan are shown in different colours', () => {
    expect(path('/plan')?.isEnabled).toBe(true);
    expect(path('/plan')?.values.Color).toBeUndefined();
    expect(path('/transformed_global_plan')?.isEnabled).toBe(true);
    expect(path('/transformed_global_plan')?.values.Color).toBe('0; 170; 255');
  });

  test('paths that repeat others are hidden', () => {
    expect(path('/optimal_trajectory')?.isEnabled).toBe(false);
    expect(path('/received_global_plan')?.isEnabled).toBe(false);
  });

  test('the trajectories of MPPI are shown', () => {
    const markers = suggestionFor('/trajectories', 'visualization_msgs/msg/MarkerArray');
    expect(markers?.isEnabled).toBe(true);
  });
});
