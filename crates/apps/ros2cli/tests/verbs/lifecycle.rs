//! `lifecycle`.

use expect_test::expect;
use periplus_graph::Actor;
use periplus_msgs::lifecycle_msgs::{
    ChangeState, ChangeStateResponse, GetAvailableTransitions, GetAvailableTransitionsResponse,
    GetState, GetStateResponse, State, Transition, TransitionDescription,
};
use periplus_ros2cli::lifecycle;

use crate::bench::Bench;

fn state(id: u8, label: &str) -> State {
    State { id, label: label.into() }
}

/// A node that can be activated once.
fn managed(bench: &Bench) -> Actor<bool> {
    let mut node = bench.node("planner").actor(false);
    node.serve::<GetState>("~/get_state", |is_active, _, _| GetStateResponse {
        current_state: if *is_active { state(3, "active") } else { state(2, "inactive") },
    })
    .unwrap();
    node.serve::<ChangeState>("~/change_state", |is_active, request, _| {
        let success = request.transition.id == Transition::TRANSITION_ACTIVATE && !*is_active;
        *is_active |= success;
        ChangeStateResponse { success }
    })
    .unwrap();
    node.serve::<GetAvailableTransitions>("~/get_available_transitions", |_, _, _| {
        let one = |id, label: &str, goal| TransitionDescription {
            transition: Transition { id, label: label.into() },
            start_state: state(2, "inactive"),
            goal_state: goal,
        };
        GetAvailableTransitionsResponse {
            available_transitions: vec![
                one(3, "activate", state(13, "activating")),
                one(2, "cleanup", state(12, "cleaningup")),
            ],
        }
    })
    .unwrap();
    node
}

#[test]
fn a_node_is_led_through_its_life() {
    let bench = Bench::new();
    let _planner = managed(&bench);
    let _plain = bench.node("lidar");
    bench.check(
        |session| lifecycle::nodes(session, false, false),
        expect![[r#"
        /planner
    "#]],
    );
    bench.check(
        |session| lifecycle::get(session, Some("/planner")),
        expect![[r#"
        inactive [2]
    "#]],
    );
    bench.check(
        |session| lifecycle::list(session, "planner", false),
        expect![[r#"
        - activate [3]
        	Start: inactive
        	Goal: activating
        - cleanup [2]
        	Start: inactive
        	Goal: cleaningup
    "#]],
    );
    bench.check(
        |session| lifecycle::set(session, "/planner", "activate"),
        expect![[r#"
        Transitioning successful
    "#]],
    );
    bench.check(
        |session| lifecycle::get(session, None),
        expect![[r#"
        /planner: active [3]
    "#]],
    );
    // The second transition is refused.
    bench.check(
        |session| lifecycle::set(session, "/planner", "3"),
        expect![[r#"
        ! Transitioning failed
    "#]],
    );
    bench.check(
        |session| lifecycle::set(session, "/planner", "actvate"),
        expect![[r#"
        ! Unknown transition requested, `actvate`; did you mean `activate`? Available ones are:
        - activate [3]
        - cleanup [2]
    "#]],
    );
    bench.check(
        |session| lifecycle::get(session, Some("/lidar")),
        expect![[r#"
        ! the node '/lidar' is not a lifecycle node
    "#]],
    );
    bench.check(
        |session| lifecycle::get(session, Some("/plner")),
        expect![[r#"
        ! Node not found: '/plner'; did you mean `/planner`?
    "#]],
    );
}
