//! Goals that cannot be reached, with the parameter file of Nav2 in Jazzy.

use std::fs;
use std::path::Path;

use periplus_graph::GoalState;

use crate::world::{BRAKING_MS, CLOSED, OUTSIDE, Setup};

/// Maximum time until the reason is published, and until a goal is refused for which recoveries are of no help \[ms\].
const MAX_REFUSAL_MS: i64 = 2000;

/// A setup with the parameter file; none without it.
fn stock() -> Option<Setup> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/nav/bringup");
    let path = folder.join("nav2_params_jazzy.yaml");
    let Ok(yaml) = fs::read_to_string(&path) else {
        eprintln!("SKIPPED: {} is missing", path.display());
        return None;
    };
    // The robot has one frame.
    let yaml = yaml.replace("base_footprint", "base_link");
    Some(Setup { yaml, ..Setup::default() })
}

/// The tree retries a goal without a path after six recoveries, of which one waits 5 s.
#[test]
fn goals_that_cannot_be_reached_have_a_reason_within_two_seconds() {
    for (pose, code, word, max_ms) in [
        (CLOSED, 208, "layer `static_layer`", 20_000),
        (OUTSIDE, 204, "the map extends", MAX_REFUSAL_MS),
    ] {
        let Some(setup) = stock() else { return };
        let mut world = setup.start();
        let sent = world.send(pose);
        assert!(world.reason_after_ms(&format!("code {code}")) <= MAX_REFUSAL_MS);
        let ended = world.finish(&sent, max_ms);
        assert_eq!((ended.state, ended.result.error_code), (GoalState::Aborted, code));
        assert!(ended.result.error_msg.contains(word), "{}", ended.result.error_msg);
        world.stands_after(BRAKING_MS);
    }
}
