//! Servers that are deactivated or shut down while the robot drives.

use periplus_graph::{GoalState, Transition};
use periplus_nav_nodes::navigation::NavigationServer;

use crate::world::{BRAKING_MS, CLOSED, FAR, World};

#[test]
fn the_robot_stands_after_a_server_is_stopped() {
    for transition in [Transition::Deactivate, Transition::Shutdown] {
        for (server, max_ms) in [
            (NavigationServer::Navigator, 50),
            (NavigationServer::Controller, 200),
            (NavigationServer::Planner, 1100),
            // The controller learns of it from a robot that makes no progress.
            (NavigationServer::VelocitySmoother, 300_000),
            (NavigationServer::CollisionMonitor, 300_000),
        ] {
            let what = format!("{} {transition:?}", server.node_name());
            let mut world = World::new();
            let sent = world.send(FAR);
            world.run_until("FollowPath");
            world.run_ms(1500);
            assert!(world.robot.command.vx_m_s > 0.3, "{what}");
            world.change(server, transition);
            if max_ms > 10_000 {
                world.stands_after(BRAKING_MS);
            }
            let ended = world.finish(&sent, max_ms);
            assert_eq!(ended.state, GoalState::Aborted, "{what}");
            world.stands_after(BRAKING_MS);
            if transition == Transition::Deactivate {
                world.change(server, Transition::Activate);
                world.serves_the_next_goal();
            }
        }
    }
}

#[test]
fn the_robot_stands_after_the_behaviors_are_stopped() {
    for transition in [Transition::Deactivate, Transition::Shutdown] {
        for stage in ["Spin", "BackUp"] {
            let mut world = World::new();
            let sent = world.send(CLOSED);
            world.run_until(stage);
            world.run_ms(600);
            world.change(NavigationServer::Behaviors, transition);
            world.stands_after(BRAKING_MS);
            let ended = world.finish(&sent, 60_000);
            assert_eq!(ended.state, GoalState::Aborted);
            if transition == Transition::Deactivate {
                world.change(NavigationServer::Behaviors, Transition::Activate);
                world.serves_the_next_goal();
            }
        }
    }
}
