//! `node`.

use expect_test::expect;
use periplus_graph::{NodeSettings, Qos};
use periplus_msgs::{geometry_msgs, std_srvs, tf2_msgs};
use periplus_ros2cli::node;

use crate::bench::Bench;

#[test]
fn nodes_are_listed_and_described() {
    let bench = Bench::new();
    let wheels = bench.graph.node(NodeSettings::new("wheels").namespace("/bot").bare()).unwrap();
    let _cmd = wheels.mailbox::<geometry_msgs::Twist>("cmd_vel", Qos::reliable(1)).unwrap();
    let _tf = wheels.publisher::<tf2_msgs::TFMessage>("/tf", Qos::reliable(1)).unwrap();
    let _reset = wheels.server::<std_srvs::Empty>("~/reset").unwrap();
    let _mover = wheels.server::<tf2_msgs::LookupTransformSendGoal>("/look/_action/send_goal");
    let _hidden = bench.node("_watcher");
    bench.check(
        |session| node::list(session, false, false),
        expect![[r#"
        /bot/wheels
    "#]],
    );
    bench.check(
        |session| node::list(session, true, false),
        expect![[r#"
        /_watcher
        /bot/wheels
    "#]],
    );
    bench.check(
        |session| node::list(session, true, true),
        expect![[r#"
        2
    "#]],
    );
    bench.check(
        |session| node::info(session, "/bot/wheels", false),
        expect![[r#"
            /bot/wheels
              Subscribers:
                /bot/cmd_vel: geometry_msgs/msg/Twist
              Publishers:
                /tf: tf2_msgs/msg/TFMessage
              Service Servers:
                /bot/wheels/reset: std_srvs/srv/Empty
              Service Clients:

              Action Servers:
                /look: tf2_msgs/action/LookupTransform
              Action Clients:

        "#]],
    );
    bench.check(
        |session| node::info(session, "/bot/wheel", false),
        expect![[r#"
        ! Unable to find node '/bot/wheel'; did you mean `/bot/wheels`?
    "#]],
    );
    let json = bench.json();
    json.check(
        |session| node::list(session, false, false),
        expect![[r#"
        {"nodes":["/bot/wheels"]}
    "#]],
    );
    json.check(|session| node::info(session, "bot/wheels", true), expect![[r#"
        {"action_clients":[],"action_servers":[{"name":"/look","types":["tf2_msgs/action/LookupTransform"]}],"name":"/bot/wheels","publishers":[{"name":"/tf","types":["tf2_msgs/msg/TFMessage"]}],"service_clients":[],"service_servers":[{"name":"/bot/wheels/reset","types":["std_srvs/srv/Empty"]},{"name":"/look/_action/send_goal","types":["tf2_msgs/action/LookupTransform_SendGoal"]}],"subscribers":[{"name":"/bot/cmd_vel","types":["geometry_msgs/msg/Twist"]}]}
    "#]]);
}
