//! Control nodes and decorators, tick by tick.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "helpers of tests, which read shared files"
)]

mod support;

use periplus_behavior_tree::{NodeStatus, PathGeometry, TreeContext, TreeValue};
use support::{Scripted, statuses, tree};

const MS: i64 = 1_000_000;

/// Ticks a node with the leaves a, b and c whose results are given, once per expected status and 10 ms apart,
/// and compares the statuses and the calls in all ticks.
fn check(root: &str, results: [&str; 3], expected: &str, calls: &str) {
    let scripted = Scripted::default();
    for (name, results) in ["a", "b", "c"].into_iter().zip(results) {
        scripted.set(name, if results.is_empty() { "S" } else { results });
    }
    let xml = root
        .replace("[abc]", "[a][b][c]")
        .replace("[ab]", "[a][b]")
        .replace("[a]", "<Leaf name='a'/>")
        .replace("[b]", "<Leaf name='b'/>")
        .replace("[c]", "<Leaf name='c'/>");
    let mut tree = tree(&xml, &scripted);
    let mut seen = Vec::new();
    let mut groups = Vec::new();
    for tick in 0..expected.len() {
        seen.push(tree.tick(tick as i64 * 10 * MS, &mut ()).unwrap());
        groups.push(scripted.calls().concat());
    }
    assert_eq!(seen, statuses(expected), "{root}");
    assert_eq!(groups.join(" "), calls, "{root}");
}

#[test]
fn sequences_resume_where_they_stopped() {
    check("<Sequence>[abc]</Sequence>", ["S", "RS", "S"], "RSS", "ab bc abc");
    check("<Sequence>[abc]</Sequence>", ["S", "FS", "S"], "FS", "ab abc");
    check("<Sequence>[ab]</Sequence>", ["K", "K", ""], "K", "ab");
    check("<Sequence>[ab]</Sequence>", ["K", "S", ""], "S", "ab");
    check("<SequenceWithMemory>[abc]</SequenceWithMemory>", ["S", "FS", "S"], "FS", "ab bc");
    check("<SequenceStar>[abc]</SequenceStar>", ["S", "RS", "F"], "RFF", "ab bc c");
    check("<Fallback>[abc]</Fallback>", ["F", "RF", "S"], "RS", "ab bc");
    check("<Fallback>[ab]</Fallback>", ["F", "F", ""], "F", "ab");
    check("<AsyncSequence>[ab]</AsyncSequence>", ["S", "S", ""], "S", "ab");
}

#[test]
fn reactive_nodes_halt_what_no_longer_runs() {
    check("<ReactiveSequence>[ab]</ReactiveSequence>", ["SSF", "R", ""], "RRF", "ab ab a!b");
    check("<ReactiveSequence>[ab]</ReactiveSequence>", ["SR", "R", ""], "RR", "ab a!b");
    check("<ReactiveFallback>[ab]</ReactiveFallback>", ["FFS", "R", ""], "RRS", "ab ab a!b");
    check("<ReactiveFallback>[ab]</ReactiveFallback>", ["K", "K", ""], "K", "ab");
}

#[test]
fn parallel_nodes_count_what_has_finished() {
    let parallel = |counts: &str| format!("<Parallel {counts}>[abc]</Parallel>");
    check(&parallel(""), ["S", "RS", "RRS"], "RRS", "abc bc c");
    check(&parallel("success_count='2'"), ["S", "RS", "R"], "RS", "abc b!c");
    check(&parallel(""), ["R", "RF", "R"], "RF", "abc ab!a!c");
    check(&parallel("failure_count='2'"), ["F", "R", "R"], "F", "a");
    let all = "<ParallelAll max_failures='2'>[abc]</ParallelAll>";
    check(all, ["F", "RS", "S"], "RS", "abc b");
    check(all, ["F", "RF", "S"], "RF", "abc b");
}

#[test]
fn conditional_nodes_choose_a_child() {
    check("<IfThenElse>[abc]</IfThenElse>", ["S", "RS", "S"], "RS", "ab b");
    check("<IfThenElse>[abc]</IfThenElse>", ["F", "S", "RF"], "RF", "ac c");
    check("<IfThenElse>[ab]</IfThenElse>", ["F", "S", ""], "F", "a");
    check("<WhileDoElse>[abc]</WhileDoElse>", ["SSF", "R", "R"], "RRR", "ab ab a!bc");
    let switch = |case: &str| {
        format!("<Switch2 variable='{case}' case_1='1.0' case_2='door'>[abc]</Switch2>")
    };
    check(&switch("1"), ["S", "S", "S"], "S", "a");
    check(&switch("door"), ["S", "S", "S"], "S", "b");
    check(&switch("x"), ["S", "S", "F"], "F", "c");
    check("<TryCatch>[abc]</TryCatch>", ["S", "F", "RS"], "RF", "abc c");
    check("<TryCatch>[abc]</TryCatch>", ["S", "S", "S"], "S", "ab");
}

#[test]
fn decorators_translate_repeat_and_time() {
    check("<Inverter>[a]</Inverter>", ["RSF", "", ""], "RFS", "a a a");
    check("<ForceSuccess>[a]</ForceSuccess>", ["F", "", ""], "S", "a");
    check("<ForceFailure>[a]</ForceFailure>", ["S", "", ""], "F", "a");
    let keep = "<KeepRunningUntilFailure>[a]</KeepRunningUntilFailure>";
    check(keep, ["SSF", "", ""], "RRF", "a a a");
    check("<Repeat num_cycles='3'>[a]</Repeat>", ["SSRS", "", ""], "RS", "aaa a");
    check("<Repeat num_cycles='3'>[a]</Repeat>", ["SF", "", ""], "F", "aa");
    let retry = "<RetryUntilSuccessful num_attempts='3'>[a]</RetryUntilSuccessful>";
    check(retry, ["FFS", "", ""], "S", "aaa");
    check(retry, ["F", "", ""], "F", "aaa");
    check("<Timeout msec='15'>[a]</Timeout>", ["R", "", ""], "RRF", "a a !a");
    check("<Delay delay_msec='15'>[a]</Delay>", ["S", "", ""], "RRS", "  a");
    check("<RunOnce>[a]</RunOnce>", ["RS", "", ""], "RSK", "a a ");
    check("<RunOnce then_skip='false'>[a]</RunOnce>", ["F", "", ""], "FF", "a ");
    check("<Precondition if='false' else='SUCCESS'>[a]</Precondition>", ["F", "", ""], "S", "");
    check("<Precondition if='1 == 1'>[a]</Precondition>", ["RF", "", ""], "RF", "a a");
    check("<Sleep msec='15'/>", ["", "", ""], "RRS", "  ");
}

#[test]
fn pre_and_post_conditions_surround_a_tick() {
    check("<Leaf name='a' _failureIf='true'/>", ["S", "", ""], "F", "");
    check("<Leaf name='a' _successIf='true'/>", ["F", "", ""], "S", "");
    check("<Sequence><Leaf name='a' _skipIf='true'/>[b]</Sequence>", ["F", "S", ""], "S", "b");
    let counted = "<Sequence><Script code='n := 0'/><Sequence><Script code='n += 1'/>
        <Leaf name='a' _while='n &lt; 2' _onHalted='h := 1'/></Sequence></Sequence>";
    check(counted, ["R", "", ""], "RR", "a a");
    // A condition that becomes false halts the node, which is then skipped.
    let stopped = "<ReactiveSequence><Script code='n := true'/><Leaf name='a' _onSuccess='n = 1'/>
        </ReactiveSequence>";
    check(stopped, ["RS", "", ""], "RS", "a a");
}

#[test]
fn a_running_node_is_halted_when_its_condition_ends() {
    let scripted = Scripted::default();
    scripted.set("a", "R");
    let root = "<Leaf name='a' _while='go' _onHalted='halted := 1'/>";
    let mut tree = tree(root, &scripted);
    tree.blackboard_mut().set("go", true).unwrap();
    assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Running));
    tree.blackboard_mut().set("go", false).unwrap();
    assert_eq!(tree.tick(1, &mut ()), Ok(NodeStatus::Skipped));
    assert_eq!(scripted.calls(), ["a", "!a"]);
    assert_eq!(tree.blackboard().get("halted"), Some(&TreeValue::Int(1)));
}

#[test]
fn nav2_control_nodes_recover_and_pipeline() {
    let recovery = "<RecoveryNode number_of_retries='2'>[ab]</RecoveryNode>";
    check(recovery, ["FFRS", "SRS", ""], "RRSS", "abab ba a a");
    check(recovery, ["F", "S", ""], "F", "ababa");
    check(recovery, ["F", "F", ""], "F", "ab");
    let pipeline = "<PipelineSequence>[abc]</PipelineSequence>";
    check(pipeline, ["RSRR", "RSS", "RS"], "RRRS", "a ab abc abc!a");
    let nonblocking = "<NonblockingSequence>[abc]</NonblockingSequence>";
    check(nonblocking, ["R", "RS", "RF"], "RF", "abc abc!a");
    let persistent = "<Sequence><Script code='i := 1'/>
        <PersistentSequence current_child_idx='{i}'>[abc]</PersistentSequence></Sequence>";
    check(persistent, ["F", "RS", "S"], "RS", "b bc");
}

#[test]
fn round_robin_wraps_or_fails_at_its_end() {
    let wrapping = "<RoundRobin wrap_around='true'>[abc]</RoundRobin>";
    check(wrapping, ["S", "S", "S"], "SSSS", "a b c a");
    check(wrapping, ["F", "F", "F"], "F", "abc");
    check(wrapping, ["F", "S", "F"], "SSS", "ab cab cab");
    let ending = "<RoundRobin>[abc]</RoundRobin>";
    check(ending, ["S", "S", "S"], "SSFS", "a b c a");
    check(ending, ["K", "K", "K"], "K", "abc");
}

#[test]
fn rates_count_the_time_of_ticks() {
    let rate = "<RateController hz='40'>[a]</RateController>";
    // Ticks are 10 ms apart, and the period is 25 ms. A root that succeeds is reset, so a parent keeps it.
    let kept = format!("<PipelineSequence>{rate}<Leaf name='b'/></PipelineSequence>");
    check(&kept, ["S", "R", ""], "RRRRRR", "ab b b ab b b");
    let single = "<SingleTrigger>[a]</SingleTrigger>";
    check(&format!("<Fallback>{single}[b]</Fallback>"), ["F", "R", ""], "RR", "ab b");
    let expired = "<ReactiveFallback><TimeExpired seconds='0.015'/>[a]</ReactiveFallback>";
    // The reactive node resets the condition while its sibling is running: its time begins again.
    check(expired, ["R", "", ""], "RRR", "a a a");
    let kept = "<PipelineSequence><Inverter><SingleTrigger><TimeExpired seconds='0.015'/>
        </SingleTrigger></Inverter>[a]</PipelineSequence>";
    check(kept, ["R", "", ""], "RR", "a a");
}

#[test]
fn a_new_goal_ends_what_a_reactive_fallback_does() {
    let scripted = Scripted::default();
    scripted.set("a", "R");
    let root = "<ReactiveFallback><GoalUpdated/><Leaf name='a'/></ReactiveFallback>";
    let mut tree = tree(root, &scripted);
    let mut tick = |goal: i64| {
        tree.blackboard_mut().set("goal", TreeValue::object(goal)).unwrap();
        tree.tick(0, &mut ()).unwrap()
    };
    // The first tick only remembers the goal.
    let statuses = [tick(1), tick(1), tick(2), tick(2), tick(2)];
    let [running, success] = [NodeStatus::Running, NodeStatus::Success];
    assert_eq!(statuses, [running, running, success, running, running]);
    assert_eq!(scripted.calls().concat(), "aa!aaa");
}

#[test]
fn endless_loops_return_after_a_bounded_number_of_ticks() {
    let scripted = Scripted::default();
    let mut tree = tree("<Repeat num_cycles='-1'><Leaf name='a'/></Repeat>", &scripted);
    assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Running));
    assert_eq!(scripted.ticks("a"), periplus_behavior_tree::MAX_WAKE_UP_COUNT);
}

/// Robot at a position, with paths that are lists of lengths.
struct Robot {
    position_m: [f64; 2],
    speed_m_s: f64,
}

impl TreeContext for Robot {
    fn robot_position_m(&mut self, _: Option<&str>, _: Option<&str>) -> Option<[f64; 2]> {
        Some(self.position_m)
    }

    fn speed_m_s(&mut self) -> f64 {
        self.speed_m_s
    }

    fn path_geometry(&mut self, path: &TreeValue) -> Option<PathGeometry> {
        let (pose_count, length_m) = *path.get::<(usize, f64)>()?;
        Some(PathGeometry { pose_count, length_m, ..PathGeometry::default() })
    }
}

#[test]
fn distance_and_speed_trigger_a_child() {
    let scripted = Scripted::default();
    scripted.set("b", "R");
    let root = "<PipelineSequence><DistanceController distance='1.0'><Leaf name='a'/>
        </DistanceController><Leaf name='b'/></PipelineSequence>";
    let mut distance = tree(root, &scripted);
    for x in [0.0, 0.9, 1.0, 1.9, 2.1] {
        let mut robot = Robot { position_m: [x, 0.0], speed_m_s: 0.0 };
        distance.tick(0, &mut robot).unwrap();
    }
    assert_eq!(scripted.calls().concat(), "abbabbab");

    let root = "<PipelineSequence><SpeedController min_rate='1' max_rate='10' min_speed='0'
        max_speed='1'><Leaf name='a'/></SpeedController><Leaf name='b'/></PipelineSequence>";
    let mut speed = tree(root, &scripted);
    // First at the highest rate; a robot that stands is planned for once a second.
    for ms in [0, 50, 100, 200, 900, 1_100] {
        let mut robot = Robot { position_m: [0.0; 2], speed_m_s: 0.0 };
        speed.tick(ms * MS, &mut robot).unwrap();
    }
    assert_eq!(scripted.calls().concat(), "abbabbbab");
}

#[test]
fn a_much_longer_path_near_the_goal_is_noticed() {
    let scripted = Scripted::default();
    scripted.set("a", "R");
    let root = "<PathLongerOnApproach path='{path}'><Leaf name='a'/></PathLongerOnApproach>";
    let mut tree = tree(root, &scripted);
    let mut robot = Robot { position_m: [0.0; 2], speed_m_s: 0.0 };
    let mut tick = |path: (usize, f64)| {
        tree.blackboard_mut().set("path", TreeValue::object(path)).unwrap();
        let status = tree.tick(0, &mut robot).unwrap();
        (status, scripted.calls().concat())
    };
    assert_eq!(tick((10, 2.0)), (NodeStatus::Success, String::new()));
    assert_eq!(tick((11, 2.1)), (NodeStatus::Success, String::new()));
    assert_eq!(tick((40, 5.0)), (NodeStatus::Running, "a".into()));
}

#[test]
fn status_changes_are_recorded_in_order() {
    let scripted = Scripted::default();
    scripted.set("a", "RS");
    let mut tree = tree("<Sequence name='s'><Leaf name='a'/></Sequence>", &scripted);
    tree.tick(5, &mut ()).unwrap();
    let changes = |tree: &mut periplus_behavior_tree::BehaviorTree| -> Vec<String> {
        let changes = tree.take_status_changes();
        changes.iter().map(|c| format!("{} {} {}", c.node, c.previous, c.current)).collect()
    };
    assert_eq!(changes(&mut tree), ["s IDLE RUNNING", "a IDLE RUNNING"]);
    assert_eq!(tree.running_leaves().map(|leaf| leaf.name).collect::<Vec<_>>(), ["a".into()]);
    tree.tick(6, &mut ()).unwrap();
    let expected = ["a RUNNING SUCCESS", "a SUCCESS IDLE", "s RUNNING SUCCESS", "s SUCCESS IDLE"];
    assert_eq!(changes(&mut tree), expected);
}
