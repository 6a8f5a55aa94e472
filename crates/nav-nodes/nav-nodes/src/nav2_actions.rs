//! Action servers and clients that have the form of a release of Nav2.
//!
//! The fields of most actions of Nav2 differ between its releases. Nodes handle goals, results and
//! feedback in the form of main ([`Nav2Action`]); the server and the client here convert them to the
//! form that programs of the release expect.

mod client;
mod server;

pub use client::{Nav2ActionClient, Nav2SentGoal};
pub use server::{Nav2GoalHandle, NewNav2Goal, serve_nav2_action, serve_nav2_service};

use periplus_costmap::Nav2Release;
use periplus_msgs::Nav2Action;

/// Use of the form of an action in a release.
trait WithForm<A: Nav2Action> {
    type Output;
    fn with<F: periplus_msgs::ReleaseForm<A>>(self) -> Self::Output;
}

/// Calls `user` with the form of `release`. Kilted has the actions of Jazzy.
fn with_form<A: Nav2Action, U: WithForm<A>>(release: Nav2Release, user: U) -> U::Output {
    match release {
        Nav2Release::Humble => user.with::<A::Humble>(),
        Nav2Release::EarlyJazzy | Nav2Release::Jazzy | Nav2Release::Kilted => {
            user.with::<A::Jazzy>()
        }
        Nav2Release::Main => user.with::<A>(),
    }
}

#[cfg(test)]
mod tests {
    use periplus_costmap::Nav2Release;
    use periplus_graph::{
        ActionSettings, Actor, GoalProgress, GoalState, Graph, GraphError, NodeSettings,
    };
    use periplus_msgs::nav2_msgs_main::{
        FollowPath, FollowPathFeedback, FollowPathGoal, FollowPathResult,
    };
    use periplus_msgs::{nav2_msgs, nav2_msgs_humble};

    use super::{Nav2ActionClient, Nav2GoalHandle, serve_nav2_action};

    type Goals = Vec<Nav2GoalHandle<FollowPath>>;

    /// Feedback and result of one goal as a client of the same release receives them.
    fn exchange(
        release: Nav2Release,
    ) -> Result<(FollowPathGoal, FollowPathFeedback, FollowPathResult), GraphError> {
        let graph = Graph::new();
        let mut server: Actor<Goals> =
            graph.node(NodeSettings::new("controller_server"))?.actor(Goals::new());
        let settings = ActionSettings::default();
        serve_nav2_action::<FollowPath, Goals>(
            &mut server,
            release,
            "follow_path",
            settings,
            |goals, new, _| goals.extend(new.accept()),
            |_, _, _| true,
        )?;
        let node = graph.node(NodeSettings::new("client"))?;
        let client = Nav2ActionClient::<FollowPath>::new(&node, release, "follow_path")?;
        assert!(client.is_ready());
        let mut goal = FollowPathGoal {
            controller_id: "FollowPath".into(),
            progress_checker_id: "progress".into(),
            ..Default::default()
        };
        goal.path.header.frame_id = "map".into();
        let sent = client.send(goal);
        graph.advance_to(1_000_000);
        assert_eq!(sent.look(), GoalProgress::Accepted);
        let goal = server.with(|goals| {
            let handle = &goals[0];
            handle.execute();
            let mut feedback = FollowPathFeedback::default();
            feedback.tracking_feedback.distance_to_goal = 2.0;
            feedback.tracking_feedback.current_path_index = 4;
            handle.feedback(feedback);
            let result = FollowPathResult {
                error_code: FollowPathResult::NO_VALID_CONTROL,
                ..Default::default()
            };
            assert!(handle.abort(result));
            (**handle.goal()).clone()
        });
        graph.advance_to(2_000_000);
        let feedback = client.feedback().remove(0).1;
        let GoalProgress::Over(state, result) = sent.look() else { panic!("{:?}", sent.look()) };
        assert_eq!(state, GoalState::Aborted);
        Ok((goal, feedback, (*result).clone()))
    }

    #[test]
    fn a_server_has_the_form_of_the_release() -> Result<(), GraphError> {
        for release in Nav2Release::ALL {
            let (goal, feedback, result) = exchange(release)?;
            let feedback = feedback.tracking_feedback;
            let is_humble = release == Nav2Release::Humble;
            assert_eq!(goal.controller_id, "FollowPath");
            assert_eq!(goal.path.header.frame_id, "map");
            assert_eq!(goal.progress_checker_id.is_empty(), is_humble, "{release}");
            assert_eq!(feedback.distance_to_goal, 2.0);
            let index = if release == Nav2Release::Main { 4 } else { 0 };
            assert_eq!(feedback.current_path_index, index, "{release}");
            assert_eq!(result.error_code, if is_humble { 0 } else { 106 }, "{release}");
        }
        Ok(())
    }

    #[test]
    fn clients_of_another_release_are_refused() -> Result<(), GraphError> {
        let graph = Graph::new();
        let mut server: Actor<Goals> =
            graph.node(NodeSettings::new("controller_server"))?.actor(Goals::new());
        serve_nav2_action::<FollowPath, Goals>(
            &mut server,
            Nav2Release::Humble,
            "follow_path",
            ActionSettings::default(),
            |_, _, _| {},
            |_, _, _| true,
        )?;
        let node = graph.node(NodeSettings::new("client"))?;
        assert!(node.action_client::<nav2_msgs_humble::FollowPath>("follow_path").is_ok());
        assert!(node.action_client::<nav2_msgs::FollowPath>("follow_path").is_err());
        Ok(())
    }
}
