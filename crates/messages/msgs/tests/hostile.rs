//! Arbitrary bytes: no panic, no hang, and no more memory than the size of the input justifies.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::sync::Arc;

use expect_test::{Expect, expect};
use periplus_msgs::{
    DynamicMessage, Format, Layout, Message, Problem, TypeRegistry, nav_msgs::OccupancyGrid,
    rcl_interfaces::ParameterDescriptor, sensor_msgs::LaserScan, std_msgs, tf2_msgs::TFMessage,
};
use proptest::prelude::*;

fn check<T: Message>(bytes: &[u8], expected: Expect) {
    let error = T::decode_cdr(bytes).expect_err("this is not a message");
    expected.assert_eq(&format!("{error}\n"));
}

#[test]
fn errors_say_where() {
    let scan = LaserScan { ranges: vec![1.0; 3], ..LaserScan::default() }.to_cdr().unwrap();
    check::<LaserScan>(
        &scan[..scan.len() - 6],
        expect![[r#"
            3 elements are announced, more than the message can hold (at `ranges`) (byte 52)
        "#]],
    );
    let mut grown = scan;
    grown.extend([0; 8]);
    check::<LaserScan>(
        &grown,
        expect![[r#"
        8 bytes follow the end of the message: it is of another type (byte 68)
    "#]],
    );
    check::<LaserScan>(
        &[0, 7, 0, 0, 1],
        expect![[r#"
        the message begins with 00 07, which is not a header of plain CDR
    "#]],
    );
    check::<LaserScan>(
        &[0, 1],
        expect![[r#"
        the message ends too early: 4 bytes are needed, 2 are left
    "#]],
    );
    check::<std_msgs::Bool>(
        &[0, 1, 0, 0, 2],
        expect![[r#"
        a truth value is 2, neither 0 nor 1 (at `data`) (byte 5)
    "#]],
    );
    check::<std_msgs::String>(
        &[0, 1, 0, 0, 2, 0, 0, 0, 0xff, 0],
        expect![[r#"
        a string is not valid UTF-8 (at `data`) (byte 10)
    "#]],
    );
}

#[test]
fn a_list_of_four_thousand_million_elements_is_refused_at_once() {
    let huge = [0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff];
    check::<TFMessage>(
        &huge,
        expect![[r#"
        4294967295 elements are announced, more than the message can hold (at `transforms`) (byte 8)
    "#]],
    );
    let mut grid = OccupancyGrid::default().to_cdr().unwrap();
    let end = grid.len();
    grid[end - 4..].copy_from_slice(&[0xff; 4]);
    check::<OccupancyGrid>(
        &grid,
        expect![[r#"
        4294967295 elements are announced, more than the message can hold (at `data`) (byte 104)
    "#]],
    );
}

#[test]
fn bounds_are_kept_both_ways() {
    let two = vec![Default::default(); 2];
    let over = ParameterDescriptor { floating_point_range: two, ..Default::default() };
    let error = over.to_cdr().expect_err("only one range is allowed");
    assert_eq!((error.count, error.limit), (2, 1));
    assert_eq!(error.field, "floating_point_range");
    let mut out = Vec::new();
    let _ = over.encode_cdr(&mut out);
    let error = ParameterDescriptor::decode_cdr(&out).expect_err("only one range is allowed");
    assert_eq!(error.problem, Problem::Bound { count: 2, limit: 1 });
}

#[test]
fn an_empty_message_takes_one_byte_in_cdr_and_none_in_ros_1() {
    let empty = std_msgs::Empty {};
    assert_eq!(empty.to_cdr().unwrap(), [0, 1, 0, 0, 0]);
    let mut out = Vec::new();
    empty.encode_ros1(&mut out).unwrap();
    assert!(out.is_empty());
}

fn any_layout() -> impl Strategy<Value = &'static Arc<Layout>> {
    let types = TypeRegistry::builtin();
    let names: Vec<&str> = types.type_names().collect();
    (0..names.len()).prop_map(move |index| types.layout(names[index]).unwrap())
}

fn any_format() -> impl Strategy<Value = Format> {
    prop_oneof![Just(Format::CDR), Just(Format::Ros1)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    /// Small values give plausible lengths, so that decoding proceeds.
    #[test]
    fn any_bytes_are_read_or_refused(
        layout in any_layout(),
        format in any_format(),
        mut bytes in prop::collection::vec(prop_oneof![4 => Just(0_u8), 2 => 0..4_u8, 1 => any::<u8>()], 0..600),
        big_endian in any::<bool>(),
    ) {
        if bytes.len() >= 4 {
            bytes[..4].copy_from_slice(&[0, u8::from(!big_endian), 0, 0]);
        }
        if let Ok(message) = DynamicMessage::decode(layout, format, &bytes) {
            let mut first = Vec::new();
            message.encode(format, &mut first).unwrap();
            let again = DynamicMessage::decode(layout, format, &first).unwrap();
            let mut second = Vec::new();
            again.encode(format, &mut second).unwrap();
            prop_assert_eq!(first, second);
            prop_assert!(message.to_yaml(&Default::default()).ends_with('\n'));
            let json = message.to_json();
            prop_assert_eq!(&DynamicMessage::from_json(layout, &json).unwrap().to_json(), &json);
        }
    }

    /// A valid message with one changed byte.
    #[test]
    fn a_flipped_byte_never_panics(at in 0_usize..400, flip in 1_u8.., ranges in prop::collection::vec(any::<f32>(), 0..40)) {
        let mut bytes = LaserScan { ranges, ..LaserScan::default() }.to_cdr().unwrap();
        let length = bytes.len();
        bytes[at % length] ^= flip;
        if let Ok(scan) = LaserScan::decode_cdr(&bytes) {
            prop_assert!(scan.to_cdr().unwrap().len() <= length + 8);
        }
    }
}
