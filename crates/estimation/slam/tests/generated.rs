//! Short drives through generated worlds of each kind, compared with ground truth. All seeds at full
//! length: `cargo run --release -p periplus-slam --example worlds`.

mod worlds;

use periplus_slam::RemarkKind;
use worlds::Moment;
use worlds::kinds::{KINDS, Verdict, outcome};

fn check(name: &str, seed: u64) {
    let Some(kind) = KINDS.iter().find(|it| it.name == name) else {
        panic!("there is no kind {name}");
    };
    let moments = (kind.drive)(seed, true);
    let outcome = outcome(kind, &moments);
    assert_eq!(
        outcome.verdict,
        Verdict::Right,
        "{:?} {:?}",
        outcome.judgement,
        outcome.slam.remarks()
    );
    // A drive that meets nothing again would be right whatever became of it.
    assert!(outcome.judgement.loops > 8, "{:?}", outcome.judgement);
}

#[test]
fn lawns_with_few_walls_and_trees() {
    check("campus", 2);
}

#[test]
fn a_campus_by_a_scanner_that_sees_far() {
    check("campus", 1);
}

#[test]
fn loops_outdoors_close_by_what_is_far_away() {
    check("campus", 11);
}

#[test]
fn decks_with_ramps() {
    check("car-park", 0);
}

#[test]
fn a_hall_of_equal_racks() {
    check("hall", 1);
}

#[test]
fn panes_that_most_rays_pass() {
    check("glass", 1);
}

#[test]
fn doors_that_open_and_close() {
    check("doors", 1);
}

#[test]
fn a_scanner_that_cost_little() {
    check("low-cost", 1);
}

/// Along walls without features the position is unobservable: a map that closes its loop by odometry alone
/// has a warning.
#[test]
fn walls_that_are_the_same_all_along_are_no_confirmation() {
    let Some(kind) = KINDS.iter().find(|it| it.name == "bare-ring") else {
        panic!("there is no such kind");
    };
    let outcome = outcome(kind, &(kind.drive)(1, true));
    let is_told = |kind: &RemarkKind| matches!(kind, RemarkKind::UnconfirmedPath(..));
    assert!(
        outcome.slam.remarks().iter().any(|it| is_told(&it.kind)),
        "{:?} {:?}",
        outcome.judgement,
        outcome.slam.remarks()
    );
}

/// Rows of equal racks: the return path matches one row as well as the next, five metres away. Seven stretches
/// support the wrong row and five the right one, so that neither closure is made.
#[test]
fn equal_racks_leave_a_loop_undecided() {
    let Some(kind) = KINDS.iter().find(|it| it.name == "hall") else {
        panic!("there is no such kind");
    };
    let part: Vec<Moment> = (kind.drive)(5, false).into_iter().skip(450).take(800).collect();
    let outcome = outcome(kind, &part);
    let is_told = |kind: &RemarkKind| matches!(kind, RemarkKind::AmbiguousClosure(..));
    let remarks = outcome.slam.remarks();
    assert!(remarks.iter().any(|it| is_told(&it.kind)), "{remarks:?}");
    assert!(outcome.judgement.loops_m < 0.1, "{:?}", outcome.judgement);
}
