//! Any text as a trajectory: an error with a line of the text, or poses that are finite, sorted, and the same
//! when they are written and read again. No score of them panics.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_evaluation::{
    AlignmentMethod, PairSelection, PoseRelation, RelativeDelta, Smoothness, SmoothnessSampling,
    Trajectory, align, ape, associate, rpe,
};

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let trajectory = match Trajectory::from_text(text) {
        Ok(trajectory) => trajectory,
        Err(error) => {
            assert!((1..=text.lines().count()).contains(&error.line) && error.column >= 1);
            return;
        }
    };
    assert!(trajectory.poses().windows(2).all(|it| it[0].stamp_s <= it[1].stamp_s));
    assert!(trajectory.poses().iter().all(|it| it.pose.is_finite()));
    let again = Trajectory::from_tum(&trajectory.to_tum()).expect("what was written can be read");
    assert_eq!(again.poses().len(), trajectory.poses().len());
    let pairs = associate(&trajectory, &again, 0.01);
    for method in [AlignmentMethod::Se2, AlignmentMethod::Sim3] {
        let _ = align(&pairs, method);
    }
    let _ = ape(&pairs, PoseRelation::FullTransformation);
    for delta in [RelativeDelta::Frames(2), RelativeDelta::Metres(1.0), RelativeDelta::Radians(1.0)] {
        for all_pairs in [false, true] {
            let selection = PairSelection { delta, all_pairs, ..PairSelection::default() };
            let _ = rpe(&pairs, PoseRelation::RotationRad, selection);
        }
    }
    let _ = Smoothness::of(&trajectory, SmoothnessSampling { step_m: 1.0, period_s: 1.0 });
});
