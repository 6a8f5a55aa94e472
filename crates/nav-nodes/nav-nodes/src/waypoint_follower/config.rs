//! Parameters of the waypoint follower and its tasks.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_motion::tables::MotionNodeParams;
use periplus_params::{Given, NamedEntity, ParamChoice, ParamValue, ParamValues, Table, params};

use crate::costmap_2d::split;
use crate::parameter_groups::ParameterGroups;

params! {
    /// Drives to poses one after the other.
    #[table(WAYPOINT_FOLLOWER, "the waypoint follower")]
    pub struct WaypointFollowerParams {
        /// Parameters of every node.
        #[shared]
        node: MotionNodeParams,
        /// Ends the goal at the first pose that was not reached, or whose task failed.
        #[param("stop_on_failure")]
        stop_on_failure: bool = true,
        /// Rate at which goals are watched.
        #[param("loop_rate", within(1.0, 1000.0))]
        loop_rate_hz: i64 = 20,
        /// Name of the task at each pose.
        #[param("waypoint_task_executor_plugin")]
        task_plugin: String = "wait_at_waypoint",
        /// Frame of converted GPS poses.
        #[param("global_frame_id", naming(NamedEntity::Frame))]
        global_frame_id: String = "map",
        /// Time for which the results of actions are kept.
        #[param("action_server_result_timeout", unit("s"), min(0.0))]
        action_server_result_timeout_s: f64 = 900,
    }
}

params! {
    /// Parameters of every task.
    pub struct WaypointTaskParams {
        /// Class, such as `nav2_waypoint_follower::WaitAtWaypoint`.
        #[param("plugin")]
        plugin: String = "nav2_waypoint_follower::WaitAtWaypoint",
        /// Enables the task.
        #[param("enabled")]
        is_enabled: bool = true,
    }
}

params! {
    /// Waits at each pose.
    #[table(WAIT_AT_WAYPOINT, "a wait at waypoints")]
    pub struct WaitAtWaypointParams {
        /// Parameters of every task.
        #[shared]
        task: WaypointTaskParams,
        /// Duration of the wait.
        #[param("waypoint_pause_duration", unit("ms"), min(0.0))]
        pause_ms: i64 = 0,
    }
}

params! {
    /// Saves an image at each pose.
    #[table(PHOTO_AT_WAYPOINT, "a photo at waypoints")]
    pub struct PhotoAtWaypointParams {
        /// Parameters of every task.
        #[shared]
        task: WaypointTaskParams,
        /// Topic of the images.
        #[param("image_topic", naming(NamedEntity::Topic))]
        image_topic: String = "/camera/color/image_raw",
        /// Folder of the files.
        #[param("save_dir")]
        save_dir: String = "/tmp/waypoint_images",
        /// Format of the files; only `png` is supported.
        #[param("image_format")]
        image_format: String = "png",
    }
}

params! {
    /// Waits for a message at each pose.
    #[table(INPUT_AT_WAYPOINT, "an input at waypoints")]
    pub struct InputAtWaypointParams {
        /// Parameters of every task.
        #[shared]
        task: WaypointTaskParams,
        /// Time after which the task fails.
        #[param("timeout", unit("s"), min(0.0))]
        timeout_s: f64 = 10,
        /// Topic of the message (std_msgs/Empty).
        #[param("input_topic", naming(NamedEntity::Topic))]
        input_topic: String = "input_at_waypoint/input",
    }
}

/// Task at each pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TaskKind {
    /// Waits for a time.
    Wait,
    /// Saves an image.
    Photo,
    /// Waits for a message.
    Input,
}

/// Classes in Nav2.
const KINDS: [(&str, TaskKind); 3] = [
    ("WaitAtWaypoint", TaskKind::Wait),
    ("PhotoAtWaypoint", TaskKind::Photo),
    ("InputAtWaypoint", TaskKind::Input),
];

impl TaskKind {
    /// Kind of a class, such as `nav2_waypoint_follower::WaitAtWaypoint`.
    #[must_use]
    pub fn of_plugin(plugin: &str) -> Option<Self> {
        let class = plugin.trim().strip_prefix("nav2_waypoint_follower")?;
        let class = class.strip_prefix("::").or_else(|| class.strip_prefix('/'))?;
        KINDS.iter().find(|(known, _)| *known == class).map(|(_, kind)| *kind)
    }

    fn table(self) -> &'static Table {
        match self {
            Self::Wait => &WAIT_AT_WAYPOINT,
            Self::Photo => &PHOTO_AT_WAYPOINT,
            Self::Input => &INPUT_AT_WAYPOINT,
        }
    }
}

/// Configuration of a waypoint follower.
#[derive(Clone, Debug, PartialEq)]
pub struct WaypointFollowerConfig {
    /// Parameters of the node, from [`WAYPOINT_FOLLOWER`].
    pub node: ParamValues,
    /// Task; none if its class is unknown, and the node then fails to configure.
    pub task: Option<TaskKind>,
    /// Parameters of the task, from the table of its kind.
    pub task_values: ParamValues,
}

impl WaypointFollowerConfig {
    /// Reads parameters given as names with dots, such as `wait_at_waypoint.enabled`, and texts.
    /// `compat` overrides the parameter of that name.
    pub fn read<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        compat: Option<Nav2Release>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let given: Vec<Given<'a>> = given.into_iter().collect();
        let mut groups = ParameterGroups::new(given.iter().cloned(), diagnostics);
        let mut node = groups.node_values(&WAYPOINT_FOLLOWER);
        if let Some(compat) = compat {
            node.set("compat", ParamValue::Text(compat.word().to_owned()));
        }
        let name = WaypointFollowerParams::from_values(&node).task_plugin;
        let is_plugin = |one: &&Given<'a>| {
            one.name.strip_prefix(name.as_str()).is_some_and(|rest| rest == ".plugin")
        };
        let plugin = given.iter().rev().find(is_plugin);
        let task = match plugin {
            Some(plugin) => TaskKind::of_plugin(&plugin.text),
            None => Some(TaskKind::Wait),
        };
        if let (None, Some(plugin)) = (task, plugin) {
            let known = KINDS.map(|(class, _)| format!("nav2_waypoint_follower::{class}"));
            let text = format!("`{name}.plugin`: there is no task `{}`", plugin.text.trim());
            groups.diagnostics.push(
                Diagnostic::error("unknown-plugin", text).at(plugin.origin).did_you_mean(
                    plugin.origin,
                    &plugin.text,
                    known.iter().map(String::as_str),
                ),
            );
        }
        let table = task.unwrap_or(TaskKind::Wait).table();
        let origin = node.origin("waypoint_task_executor_plugin");
        let task_values = groups.group_values(table, &name, origin);
        groups.finish();
        Self { node, task, task_values }
    }

    /// Parameters of the node.
    #[must_use]
    pub fn params(&self) -> WaypointFollowerParams {
        WaypointFollowerParams::from_values(&self.node)
    }

    /// All parameters, with names such as `wait_at_waypoint.enabled`.
    #[must_use]
    pub fn values(&self) -> ParamValues {
        let mut values = self.node.clone();
        values.add_group(self.params().task_plugin, self.task_values.clone());
        values
    }

    /// Copies values of [`Self::values`] that were changed.
    pub(super) fn adopt(&mut self, all: &ParamValues) {
        let group = self.params().task_plugin;
        self.node = split(all, "", &self.node);
        self.task_values = split(all, &group, &self.task_values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_are_read_by_their_plugin() {
        let check = |given: &[(&str, &str)], task: Option<TaskKind>, found: &[&str]| {
            let mut diagnostics = Diagnostics::new();
            let given = given.iter().map(|(name, text)| Given::new(name, *text));
            let config = WaypointFollowerConfig::read(given, None, &mut diagnostics);
            assert_eq!(config.task, task);
            let codes: Vec<&str> = diagnostics.iter().map(|finding| finding.code).collect();
            assert_eq!(codes, found);
        };
        check(&[("wait_at_waypoint.waypoint_pause_duration", "200")], Some(TaskKind::Wait), &[]);
        let photo = [
            ("waypoint_task_executor_plugin", "snap"),
            ("snap.plugin", "nav2_waypoint_follower::PhotoAtWaypoint"),
            ("snap.save_dir", "/photos"),
        ];
        check(&photo, Some(TaskKind::Photo), &[]);
        let wrong = [("wait_at_waypoint.plugin", "nav2_waypoint_follower::Wait")];
        check(&wrong, None, &["unknown-plugin"]);
        for table in [&WAYPOINT_FOLLOWER, &WAIT_AT_WAYPOINT, &PHOTO_AT_WAYPOINT, &INPUT_AT_WAYPOINT]
        {
            assert_eq!(table.faults(), Vec::<String>::new());
        }
    }
}
