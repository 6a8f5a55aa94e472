//! Lookups and error messages of the buffer.
#![allow(clippy::unwrap_used, reason = "a test states its preconditions")]

use expect_test::expect;
use periplus_geometry::{DQuat, DVec3, Pose, Rpy};
use periplus_tf::{
    Buffer, LookupErrorKind, RejectedTransform, StampedTransform, TransformKind, TransformLookup,
};
use proptest::prelude::*;

const S: i64 = 1_000_000_000;

fn along_x(parent: &str, child: &str, stamp_ns: i64, x_m: f64) -> StampedTransform {
    StampedTransform::new(parent, child, stamp_ns, Pose::from_xyz(x_m, 0.0, 0.0))
}

fn moving(transforms: &[(&str, &str, i64, f64)]) -> Buffer {
    let mut buffer = Buffer::default();
    for &(parent, child, seconds, x_m) in transforms {
        buffer
            .set(&along_x(parent, child, seconds * S, x_m), "test", TransformKind::Moving)
            .unwrap();
    }
    buffer
}

fn x_m(buffer: &Buffer, target: &str, source: &str, time_ns: i64) -> f64 {
    buffer.lookup(target, source, time_ns).unwrap().target_from_source.translation.x
}

#[test]
fn up_down_and_across() {
    let mut buffer = moving(&[("map", "odom", 1, 10.0), ("odom", "base", 1, 2.0)]);
    buffer.set(&along_x("base", "laser", 0, 0.5), "urdf", TransformKind::Fixed).unwrap();
    buffer.set(&along_x("odom", "ball", S, 7.0), "camera", TransformKind::Moving).unwrap();
    assert_eq!(x_m(&buffer, "map", "laser", S), 12.5);
    assert_eq!(x_m(&buffer, "laser", "map", S), -12.5);
    assert_eq!(x_m(&buffer, "laser", "ball", S), 4.5);
    assert_eq!(x_m(&buffer, "base", "laser", 55 * S), 0.5, "what is fixed is so at any time");
    assert_eq!(buffer.chain("ball", "laser").unwrap(), ["laser", "base", "odom", "ball"]);
    assert_eq!((buffer.parent_of("laser"), buffer.parent_of("map")), (Some("base"), None));
    assert_eq!(buffer.authority_of("ball"), Some("camera"));
}

#[test]
fn time_zero_is_the_newest_that_all_have() {
    let mut buffer = moving(&[
        ("map", "odom", 1, 0.0),
        ("map", "odom", 3, 2.0),
        ("odom", "base", 2, 0.0),
        ("odom", "base", 4, 2.0),
    ]);
    buffer.set(&along_x("base", "laser", 0, 0.5), "urdf", TransformKind::Fixed).unwrap();
    let found = buffer.lookup("map", "laser", 0).unwrap();
    assert_eq!(found.time_ns, 3 * S);
    assert_eq!(found.target_from_source.translation.x, 3.5);
    assert_eq!(buffer.lookup("base", "laser", 0).unwrap().time_ns, 0);
    assert_eq!(buffer.lookup("base", "base", 0).unwrap().time_ns, 4 * S);
    assert_eq!(buffer.lookup("nobody", "nobody", 5).unwrap().time_ns, 5);
}

#[test]
fn the_words_of_tf2() {
    let mut buffer =
        moving(&[("odom", "base", 2, 0.0), ("odom", "base", 3, 0.0), ("a", "b", 2, 0.0)]);
    let said = |buffer: &Buffer, target: &str, source: &str, time_ns| {
        let error = buffer.lookup(target, source, time_ns).unwrap_err();
        format!("{}: {error}", error.kind.exception())
    };
    expect![[r#"ForwardExtrapolationException: Lookup would require extrapolation into the future.  Requested time 4.000000 but the latest data is at time 3.000000, when looking up transform from frame [base] to frame [odom]"#]]
        .assert_eq(&said(&buffer, "odom", "base", 4 * S));
    expect![[r#"BackwardExtrapolationException: Lookup would require extrapolation into the past.  Requested time 1.500000 but the earliest data is at time 2.000000, when looking up transform from frame [odom] to frame [base]"#]]
        .assert_eq(&said(&buffer, "base", "odom", 3 * S / 2));
    expect![[r#"NoDataForExtrapolationException: Lookup would require extrapolation at time 4.000000, but only time 2.000000 is in the buffer, when looking up transform from frame [b] to frame [a]"#]]
        .assert_eq(&said(&buffer, "a", "b", 4 * S));
    expect!["ConnectivityException: Could not find a connection between 'a' and 'base' because they are not part of the same tree.Tf has two or more unconnected trees."]
        .assert_eq(&said(&buffer, "a", "base", 2 * S));
    expect![[
        r#"LookupException: "map" passed to lookupTransform argument target_frame does not exist. "#
    ]]
    .assert_eq(&said(&buffer, "map", "base", 0));
    expect![[r#"InvalidArgumentException: Invalid argument "/odom" passed to lookupTransform argument target_frame - in tf2 frame_ids cannot start with a '/'"#]]
        .assert_eq(&said(&buffer, "/odom", "base", 0));
    let cannot = buffer.can_transform("map", "base", 0).unwrap_err();
    expect![[r#"Invalid frame ID "map" passed to canTransform argument target_frame - frame does not exist"#]]
        .assert_eq(&cannot.to_string());
    assert!(buffer.can_transform("odom", "base", 0).is_ok());

    buffer.set(&along_x("base", "odom", 3 * S, 0.0), "a circle", TransformKind::Moving).unwrap();
    let error = buffer.lookup("base", "a", 0).unwrap_err();
    assert_eq!(error.kind, LookupErrorKind::Lookup);
    assert!(error.message.starts_with("The tf tree is invalid because it contains a loop."));
    assert!(buffer.chain("base", "a").is_none());
}

#[test]
fn what_is_refused() {
    let mut buffer = moving(&[("odom", "base", 20, 0.0), ("odom", "base", 21, 0.0)]);
    let mut refused = |transform: StampedTransform| {
        buffer.set(&transform, "x", TransformKind::Moving).unwrap_err()
    };
    assert_eq!(refused(along_x("odom", "", S, 0.0)), RejectedTransform::NoChild);
    assert_eq!(refused(along_x("", "b", S, 0.0)).name(), "TF_NO_FRAME_ID");
    assert_eq!(refused(along_x("/b", "b", S, 0.0)).name(), "TF_SELF_TRANSFORM");
    assert_eq!(refused(along_x("a", "b", S, f64::NAN)).name(), "TF_NAN_INPUT");
    let stretched = StampedTransform {
        rotation: DQuat::from_xyzw(0.0, 0.0, 0.0, 1.006),
        ..along_x("a", "b", S, 0.0)
    };
    assert_eq!(refused(stretched).name(), "TF_DENORMALIZED_QUATERNION");
    assert_eq!(refused(along_x("odom", "base", 9 * S, 0.0)).name(), "TF_OLD_DATA");
    assert!(!buffer.has_frame("b"));
}

#[test]
fn across_time() {
    let buffer = moving(&[("odom", "base", 1, 1.0), ("odom", "base", 2, 3.0)]);
    let found = buffer
        .lookup_across(TransformLookup {
            target: "base",
            target_time_ns: S,
            source: "base",
            source_time_ns: 2 * S,
            fixed: "odom",
        })
        .unwrap();
    assert_eq!(found.target_from_source.translation, DVec3::new(2.0, 0.0, 0.0));
}

#[test]
fn another_kind_or_a_clearing_forgets() {
    let mut buffer = moving(&[("odom", "base", 1, 1.0)]);
    buffer.set(&along_x("odom", "base", 0, 5.0), "x", TransformKind::Fixed).unwrap();
    assert_eq!(x_m(&buffer, "odom", "base", S), 5.0);
    buffer.set(&along_x("odom", "base", 3 * S, 6.0), "x", TransformKind::Moving).unwrap();
    assert_eq!(x_m(&buffer, "odom", "base", 0), 6.0);
    buffer.clear();
    assert!(buffer.lookup("odom", "base", 0).is_err() && buffer.has_frame("base"));
}

#[test]
fn frames_as_yaml() {
    let mut buffer = moving(&[("odom", "base", 1, 0.0), ("odom", "base", 3, 0.0)]);
    buffer
        .set(&along_x("base", "laser", S, 0.0), "Authority undetectable", TransformKind::Fixed)
        .unwrap();
    let yaml = buffer.frames_yaml(Some(4 * S + S / 2));
    // tf2 prints a space behind the name of each frame, which no line of this file may end with.
    assert_eq!(yaml.matches(": \n").count(), 2);
    expect![[r#"
        base:
          parent: 'odom'
          broadcaster: 'test'
          rate: 1.000
          most_recent_transform: 3.000000
          oldest_transform: 1.000000
          transform_delay: 1.500
          buffer_length: 2.000
        laser:
          parent: 'base'
          broadcaster: 'Authority undetectable'
          rate: 10000.000
          most_recent_transform: 0.000000
          oldest_transform: 0.000000
          transform_delay: 4.500
          buffer_length: 0.000
    "#]]
    .assert_eq(&yaml.replace(": \n", ":\n"));
    assert_eq!(Buffer::default().frames_yaml(None), "[]");
}

fn pose() -> impl Strategy<Value = Pose> {
    ([-9.0..9.0, -9.0..9.0, -9.0..9.0_f64], [-3.0..3.0, -1.5..1.5, -3.0..3.0_f64])
        .prop_map(|(xyz, [roll, pitch, yaw])| Pose::from_xyz_rpy(xyz, Rpy { roll, pitch, yaw }))
}

proptest! {
    #[test]
    fn a_chain_is_the_product_of_its_links(poses in prop::collection::vec(pose(), 1..6)) {
        let mut buffer = Buffer::default();
        let mut whole = Pose::IDENTITY;
        for (depth, pose) in poses.iter().enumerate() {
            let (parent, child) = (format!("f{depth}"), format!("f{}", depth + 1));
            buffer.set(&StampedTransform::new(parent, child, S, *pose), "x", TransformKind::Moving).unwrap();
            whole = whole * *pose;
        }
        let last = format!("f{}", poses.len());
        let down = buffer.lookup("f0", &last, S).unwrap().target_from_source;
        let (metres, radians) = down.distance_to(whole);
        prop_assert!(metres < 1e-9 && radians < 1e-9);
        let up = buffer.lookup(&last, "f0", S).unwrap().target_from_source;
        let (metres, radians) = (up * down).distance_to(Pose::IDENTITY);
        prop_assert!(metres < 1e-9 && radians < 1e-9);
    }
}
