//! Files of behavior trees with mistakes.

use periplus_graph::{GoalProgress, GoalState, LifecycleState};
use periplus_msgs::nav2_msgs_main::NavigateToPoseGoal;
use periplus_nav_nodes::navigation::NavigationServer;

use crate::world::{NEAR, Setup, goal};

fn tree(body: &str) -> String {
    format!(
        "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">\n<BehaviorTree ID=\"Main\">\n{body}\n</BehaviorTree>\n</root>\n"
    )
}

/// Text of a file, and words of the error.
fn broken() -> Vec<(String, Vec<&'static str>)> {
    vec![
        (String::new(), vec!["/broken.xml"]),
        ("<root BTCPP_format=\"4\"><BehaviorTree".to_owned(), vec!["/broken.xml:1"]),
        ("not XML".to_owned(), vec!["/broken.xml:1:1"]),
        ("<root BTCPP_format=\"4\"/>".to_owned(), vec!["/broken.xml"]),
        (tree("<Fly/>"), vec!["/broken.xml:3:", "Fly"]),
        (tree("<Wait wait_time=\"1\"/>"), vec!["/broken.xml:3:", "wait_time"]),
        (tree("<Wait wait_duration=\"soon\"/>"), vec!["wait_duration"]),
        (tree("<SubTree ID=\"Other\"/>"), vec!["Other"]),
        (tree("<SubTree ID=\"Main\"/>"), vec!["Main"]),
        (tree("<Sequence/>"), vec!["Sequence"]),
    ]
}

#[test]
fn a_broken_tree_of_a_goal_fails_with_its_place() {
    for (text, words) in broken() {
        let mut world = Setup::default().file("/broken.xml", &text).start();
        let behavior_tree = "/broken.xml".to_owned();
        let sent = world.client.send(NavigateToPoseGoal { behavior_tree, ..goal(NEAR) });
        let ended = world.finish(&sent, 500);
        assert_eq!(ended.state, GoalState::Aborted, "{text}");
        for word in words {
            let message = &ended.result.error_msg;
            assert!(message.contains(word), "{word} is not in: {message}");
        }
        world.stands_after(0);
        world.reaches(NEAR);
    }
}

#[test]
fn a_tree_whose_file_is_missing_fails_with_its_name() {
    let mut world = Setup::default().start();
    for name in ["/missing.xml", "missing_id"] {
        let behavior_tree = name.to_owned();
        let sent = world.client.send(NavigateToPoseGoal { behavior_tree, ..goal(NEAR) });
        world.fails(&sent, 500, 0, &[name]);
    }
    world.reaches(NEAR);
}

/// Trees that can be loaded, and fail when they run.
#[test]
fn a_tree_without_a_port_or_a_child_fails_when_it_runs() {
    for (body, word) in [
        ("<ComputePathToPose planner_id=\"GridBased\" path=\"{path}\"/>", "goal"),
        ("<FollowPath controller_id=\"FollowPath\"/>", "Path is empty"),
        ("<FollowPath path=\"{nothing}\" controller_id=\"FollowPath\"/>", "Path is empty"),
        ("<RecoveryNode number_of_retries=\"1\"><Wait/></RecoveryNode>", "RecoveryNode"),
        ("<SmoothPath smoothed_path=\"{path}\"/>", "empty"),
    ] {
        let mut world = Setup::default().file("/broken.xml", &tree(body)).start();
        let behavior_tree = "/broken.xml".to_owned();
        let sent = world.client.send(NavigateToPoseGoal { behavior_tree, ..goal(NEAR) });
        let ended = world.finish(&sent, 2000);
        assert_eq!(ended.state, GoalState::Aborted, "{body}");
        assert!(ended.result.error_msg.contains(word), "{}", ended.result.error_msg);
        world.stands_after(0);
        world.reaches(NEAR);
    }
}

#[test]
fn a_broken_default_tree_keeps_the_navigator_inactive() {
    for (text, _) in broken() {
        let mut world = Setup::default()
            .replace("bt_loop_duration: 10", "default_nav_to_pose_bt_xml: /broken.xml")
            .file("/broken.xml", &text)
            .start();
        let navigator = world.node(NavigationServer::Navigator).lifecycle();
        assert_eq!(navigator.state(), LifecycleState::Inactive, "{text}");
        let sent = world.send(NEAR);
        world.run_ms(50);
        assert_eq!(sent.look(), GoalProgress::Rejected, "{text}");
        world.stands_after(0);
    }
}
