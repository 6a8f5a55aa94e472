//! `interface`.

use expect_test::expect;
use periplus_ros2cli::interface::{self, Comments};
use periplus_rosidl::InterfaceKind;

use crate::bench::Bench;

#[test]
fn types_are_listed() {
    let bench = Bench::new();
    let all = bench.run(|session| interface::list(session, &[]));
    let titles = all.lines().filter(|line| !line.starts_with("    "));
    assert_eq!(titles.collect::<Vec<_>>(), ["Messages:", "Services:", "Actions:"]);
    assert!(all.contains("\n    sensor_msgs/msg/LaserScan\n"), "{all}");
    let actions = bench.run(|session| interface::list(session, &[InterfaceKind::Action]));
    assert!(actions.starts_with("Actions:\n    "), "{actions}");
    assert!(actions.contains("    tf2_msgs/action/LookupTransform\n"), "{actions}");
    bench.check(
        |session| interface::package(session, "std_srvs"),
        expect![[r#"
        std_srvs/srv/Empty
        std_srvs/srv/SetBool
        std_srvs/srv/Trigger
    "#]],
    );
    bench.check(
        |session| interface::package(session, "std_srv"),
        expect![[r#"
        ! Unknown package 'std_srv'; did you mean `std_srvs`?
    "#]],
    );
    let packages = bench.run(|session| interface::packages(session, &[InterfaceKind::Action]));
    assert!(packages.lines().any(|name| name == "tf2_msgs"), "{packages}");
}

#[test]
fn types_are_shown() {
    let bench = Bench::new();
    let show = |name: &str, comments| bench.run(|session| interface::show(session, name, comments));
    expect![[r#"
        # Twist with a time and a frame.

        std_msgs/Header header
        	builtin_interfaces/Time stamp
        		int32 sec
        		uint32 nanosec
        	string frame_id
        Twist twist
        	Vector3 linear
        		float64 x
        		float64 y
        		float64 z
        	Vector3 angular
        		float64 x
        		float64 y
        		float64 z
    "#]]
    .assert_eq(&show("geometry_msgs/msg/TwistStamped", Comments::Own));
    expect![[r#"
        std_msgs/Header header
        	builtin_interfaces/Time stamp
        		int32 sec
        		uint32 nanosec
        	string frame_id
        Twist twist
        	Vector3 linear
        		float64 x
        		float64 y
        		float64 z
        	Vector3 angular
        		float64 x
        		float64 y
        		float64 z
    "#]]
    .assert_eq(&show("geometry_msgs/TwistStamped", Comments::None));
    expect![[r#"
        bool data
        ---
        bool success
        string message
    "#]]
    .assert_eq(&show("std_srvs/srv/SetBool", Comments::None));
    expect![[r#"
        ! Unknown type 'std_srvs/srv/SetBol'; did you mean `std_srvs/srv/SetBool`? A type is written like `sensor_msgs/msg/LaserScan`; `--interfaces DIR` adds packages
    "#]].assert_eq(&show("std_srvs/srv/SetBol", Comments::None));
    bench.check(
        |session| interface::proto(session, "std_srvs/SetBool", true),
        expect![[r#"
        "data: false
        "
    "#]],
    );
    bench.check(
        |session| interface::proto(session, "std_msgs/Header", false),
        expect![[r#"
        stamp:
          sec: 0
          nanosec: 0
        frame_id: ''

    "#]],
    );
}
