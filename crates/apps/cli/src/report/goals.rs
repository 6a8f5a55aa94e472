//! Goals of a run and what became of them.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use periplus_bags::files::Bag;
use periplus_msgs::action_msgs::GoalStatusArray;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_session::recorded::{each, each_at, has_type};

use super::OpenRun;
use super::html::{Section, escape, paragraph, table};
use crate::error::CliError;

/// Maximum number of goals in the table.
const MAX_GOAL_COUNT: usize = 200;

/// Ends of the names of actions whose goals a user sets.
const TOP_ACTIONS: [&str; 5] =
    ["navigate_to_pose", "navigate_through_poses", "follow_waypoints", "move_base", "dock_robot"];

/// Value of `action_msgs/msg/GoalStatus` of a goal that was reached.
const SUCCEEDED: i8 = 4;

/// Names of the values of `action_msgs/msg/GoalStatus`.
const STATUS_NAMES: [&str; 7] =
    ["unknown", "accepted", "executing", "canceling", "succeeded", "canceled", "aborted"];

/// Goal of an action.
struct ActionGoal {
    action: String,
    /// Times of recording \[ns\].
    start_ns: i64,
    end_ns: i64,
    status: i8,
}

/// Returns the positions of goals that users set \[m\].
pub(super) fn goal_poses(bag: &Bag) -> Result<Vec<[f64; 2]>, CliError> {
    let is_goal = |name: &str| {
        ["goal_pose", "goal", "goal_update"].contains(&name.rsplit('/').next().unwrap_or_default())
    };
    let topics: Vec<&str> = bag
        .topics()
        .iter()
        .filter(|topic| is_goal(&topic.name) && has_type(topic, "PoseStamped"))
        .map(|topic| topic.name.as_str())
        .collect();
    let mut goals = Vec::new();
    each::<PoseStamped>(bag, &topics, |_, goal| {
        let position = goal.pose.position;
        if position.x.is_finite() && position.y.is_finite() {
            goals.push([position.x, position.y]);
        }
    })?;
    Ok(goals)
}

pub(super) fn section(run: &OpenRun) -> Result<Option<Section>, CliError> {
    let suffix = "/_action/status";
    let topics: Vec<&str> = run
        .bag
        .topics()
        .iter()
        .map(|topic| topic.name.as_str())
        .filter(|name| name.ends_with(suffix))
        .collect();
    let mut goals: BTreeMap<(String, [u8; 16]), ActionGoal> = BTreeMap::new();
    each_at::<GoalStatusArray>(&run.bag, &topics, |topic, time_ns, message| {
        let action = topic.strip_suffix(suffix).unwrap_or(topic);
        for status in &message.status_list {
            let key = (action.to_owned(), status.goal_info.goal_id.uuid);
            let goal = goals.entry(key).or_insert_with(|| ActionGoal {
                action: action.to_owned(),
                start_ns: time_ns,
                end_ns: time_ns,
                status: status.status,
            });
            if goal.status != status.status {
                (goal.status, goal.end_ns) = (status.status, time_ns);
            }
        }
    })?;
    if goals.is_empty() {
        return Ok(None);
    }
    let mut goals: Vec<ActionGoal> = goals.into_values().collect();
    goals.sort_by_key(|goal| goal.start_ns);
    // Actions that serve a goal of the user are summed up.
    let is_of_user = |goal: &ActionGoal| TOP_ACTIONS.iter().any(|it| goal.action.ends_with(it));
    let has_top = goals.iter().any(is_of_user);
    let (goals, others): (Vec<ActionGoal>, Vec<ActionGoal>) =
        goals.into_iter().partition(|goal| !has_top || is_of_user(goal));
    let first_ns = run.bag.span_ns().unwrap_or_default().0;
    let mut rows = String::new();
    for goal in goals.iter().take(MAX_GOAL_COUNT) {
        let name = usize::try_from(goal.status).ok().and_then(|it| STATUS_NAMES.get(it));
        let name = *name.unwrap_or(&STATUS_NAMES[0]);
        let class = if name == "aborted" { " class=\"error\"" } else { "" };
        let _ = writeln!(
            rows,
            "<tr><td class=\"number\">{:.1}</td><td>{}</td><td{class}>{name}</td><td class=\"number\">{:.1}</td></tr>",
            (goal.start_ns - first_ns) as f64 * 1e-9,
            escape(&goal.action),
            (goal.end_ns - goal.start_ns) as f64 * 1e-9,
        );
    }
    let mut sums: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
    for goal in &others {
        let (count, succeeded) = sums.entry(&goal.action).or_default();
        *count += 1;
        *succeeded += u64::from(goal.status == SUCCEEDED);
    }
    let caption = format!(
        "{} goals, {} succeeded",
        goals.len(),
        goals.iter().filter(|it| it.status == SUCCEEDED).count()
    );
    let mut body = table(&caption, &["time [s]", "action", "result", "duration [s]"], &rows);
    if !sums.is_empty() {
        let parts = sums.iter().map(|(action, (count, succeeded))| {
            format!("{action} {count} goals, {succeeded} succeeded")
        });
        let parts: Vec<String> = parts.collect();
        body.push_str(&paragraph(&format!(
            "Actions that serve these: {}. A goal that a newer one replaces is aborted.",
            parts.join("; ")
        )));
    }
    Ok(Some(Section { title: run.heading("Goals"), body }))
}
