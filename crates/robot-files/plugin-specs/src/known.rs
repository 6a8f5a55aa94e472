//! What is known of a plugin.

use periplus_params::Table;

/// Which simulator, and which bridge, reads a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Family {
    /// Gazebo Classic with the plugins of `gazebo_ros_pkgs` for ROS 1.
    ClassicRos1,
    /// Gazebo Classic with the plugins of `gazebo_ros_pkgs` for ROS 2.
    ClassicRos2,
    /// Gazebo Classic's own plugins.
    Classic,
    /// Gazebo since Citadel (once Ignition): systems and panels.
    Gz,
}

/// What a plugin is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// It moves a robot by velocity commands.
    Drive,
    /// It moves joints.
    Control,
    /// It publishes what a sensor measures.
    Sensor,
    /// It publishes the state of models.
    State,
    /// It acts on bodies: forces, slip, suction, fluids.
    Effect,
    /// It serves the whole world.
    World,
    /// It is a part of the window.
    Gui,
}

/// What Periplus does with a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// It is simulated.
    Simulated,
    /// What it does is there without it.
    BuiltIn,
    /// The viewer offers what it does.
    Viewer,
    /// It is kept, not run.
    Kept,
}

/// Which way a topic flows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// The plugin publishes it.
    Out,
    /// The plugin listens to it.
    In,
}

/// A topic of a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Topic {
    /// Which way it flows.
    pub flow: Flow,
    /// Its name. `{model}`, `{world}` and `{sensor}` stand for names of the scene, any other
    /// `{parameter}` for a parameter's value.
    pub name: &'static str,
    /// The parameter that replaces the name.
    pub set_by: Option<&'static str>,
    /// The parameter that must be true for the topic to exist.
    pub when: Option<&'static str>,
}

/// A plugin that we know.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// Who reads it.
    pub family: Family,
    /// The library without `lib` and `.so`, in today's spelling: `gazebo_ros_diff_drive`,
    /// `gz-sim-diff-drive-system`, `MinimalScene`.
    pub id: &'static str,
    /// Names of the classes in a library of today's Gazebo, the usual one first; a `<plugin>`
    /// must name one of them.
    pub classes: &'static [&'static str],
    /// What it is for.
    pub role: Role,
    /// What Periplus does with it.
    pub support: Support,
    /// Its topics.
    pub topics: &'static [Topic],
    /// Its parameters.
    pub table: Table,
    /// Whether it reads parameters that the table does not list.
    pub open: bool,
}

/// A topic that a plugin publishes.
pub(crate) const fn publishes(name: &'static str) -> Topic {
    Topic { flow: Flow::Out, name, set_by: None, when: None }
}

/// A topic that a plugin listens to.
pub(crate) const fn listens(name: &'static str) -> Topic {
    Topic { flow: Flow::In, name, set_by: None, when: None }
}

impl Topic {
    pub(crate) const fn set_by(self, parameter: &'static str) -> Self {
        Self { set_by: Some(parameter), ..self }
    }

    pub(crate) const fn when(self, parameter: &'static str) -> Self {
        Self { when: Some(parameter), ..self }
    }
}

impl Known {
    pub(crate) const fn new(
        family: Family,
        id: &'static str,
        role: Role,
        support: Support,
        table: Table,
    ) -> Self {
        Self { family, id, classes: &[], role, support, topics: &[], table, open: false }
    }

    pub(crate) const fn topics(self, topics: &'static [Topic]) -> Self {
        Self { topics, ..self }
    }

    pub(crate) const fn classes(self, classes: &'static [&'static str]) -> Self {
        Self { classes, ..self }
    }

    pub(crate) const fn open(self) -> Self {
        Self { open: true, ..self }
    }

    /// The file name as people write it today.
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
