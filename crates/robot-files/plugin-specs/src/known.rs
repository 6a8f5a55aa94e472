//! Specification of a plugin.

use periplus_params::Table;

/// Simulator, and bridge to ROS, that a plugin is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Family {
    /// Gazebo Classic with the plugins of `gazebo_ros_pkgs` for ROS 1.
    ClassicRos1,
    /// Gazebo Classic with the plugins of `gazebo_ros_pkgs` for ROS 2.
    ClassicRos2,
    /// Gazebo Classic's own plugins.
    Classic,
    /// Gazebo since Citadel (formerly Ignition): systems and GUI plugins.
    Gz,
}

/// Purpose of a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Moves a robot by velocity commands.
    Drive,
    /// Moves joints.
    Control,
    /// Publishes sensor data.
    Sensor,
    /// Publishes the state of models.
    State,
    /// Acts on bodies: forces, slip, suction, fluids.
    Effect,
    /// Serves the whole world.
    World,
    /// Part of the GUI.
    Gui,
}

/// Support of a plugin by Periplus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// Simulated.
    Simulated,
    /// Built in: the function is available without the plugin.
    BuiltIn,
    /// Available in the viewer.
    Viewer,
    /// Kept in the file, not run.
    Kept,
}

/// Direction of a topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TopicDirection {
    /// Published by the plugin.
    Out,
    /// Subscribed to by the plugin.
    In,
}

/// Topic of a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PluginTopic {
    /// Direction of the topic.
    pub flow: TopicDirection,
    /// Its name. `{model}`, `{world}` and `{sensor}` are replaced by names of the scene, any other
    /// `{parameter}` by the value of the parameter.
    pub name: &'static str,
    /// Parameter that replaces the name.
    pub set_by: Option<&'static str>,
    /// Parameter that must be true for the topic to exist.
    pub when: Option<&'static str>,
}

/// Specification of a known plugin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PluginSpec {
    /// Simulator that it is for.
    pub family: Family,
    /// Library without `lib` and `.so`, with its current name: `gazebo_ros_diff_drive`,
    /// `gz-sim-diff-drive-system`, `MinimalScene`.
    pub id: &'static str,
    /// Names of the classes in a library of current Gazebo, the usual one first; the `name` of a `<plugin>`
    /// must be one of them.
    pub classes: &'static [&'static str],
    /// Its purpose.
    pub role: Role,
    /// Support by Periplus.
    pub support: Support,
    /// Its topics.
    pub topics: &'static [PluginTopic],
    /// Its parameters.
    pub table: Table,
    /// True if it reads parameters that are not in the table.
    pub open: bool,
}

/// Topic that a plugin publishes.
pub(crate) const fn publishes(name: &'static str) -> PluginTopic {
    PluginTopic { flow: TopicDirection::Out, name, set_by: None, when: None }
}

/// Topic that a plugin subscribes to.
pub(crate) const fn listens(name: &'static str) -> PluginTopic {
    PluginTopic { flow: TopicDirection::In, name, set_by: None, when: None }
}

impl PluginTopic {
    pub(crate) const fn set_by(self, parameter: &'static str) -> Self {
        Self { set_by: Some(parameter), ..self }
    }

    pub(crate) const fn when(self, parameter: &'static str) -> Self {
        Self { when: Some(parameter), ..self }
    }
}

impl PluginSpec {
    pub(crate) const fn new(
        family: Family,
        id: &'static str,
        role: Role,
        support: Support,
        table: Table,
    ) -> Self {
        Self { family, id, classes: &[], role, support, topics: &[], table, open: false }
    }

    pub(crate) const fn topics(self, topics: &'static [PluginTopic]) -> Self {
        Self { topics, ..self }
    }

    pub(crate) const fn classes(self, classes: &'static [&'static str]) -> Self {
        Self { classes, ..self }
    }

    pub(crate) const fn open(self) -> Self {
        Self { open: true, ..self }
    }

    /// Usual file name of the library.
    #[must_use]
    pub fn filename(&self) -> String {
        match self.family {
            Family::Gz => self.id.to_owned(),
            Family::ClassicRos1 | Family::ClassicRos2 | Family::Classic => {
                format!("lib{}.so", self.id)
            }
        }
    }
}

impl std::fmt::Display for Family {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::ClassicRos1 => "Gazebo Classic with ROS 1",
            Self::ClassicRos2 => "Gazebo Classic with ROS 2",
            Self::Classic => "Gazebo Classic",
            Self::Gz => "Gazebo (gz-sim)",
        })
    }
}
