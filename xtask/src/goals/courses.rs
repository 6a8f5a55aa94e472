//! Worlds of the drives, each with a tour through it for the map.

use std::path::{Path, PathBuf};

use crate::step::root;

/// A world.
pub(super) struct Course {
    pub(super) name: &'static str,
    /// File below the project, or below the shared data.
    file: &'static str,
    is_shared: bool,
    /// Folders of the shared data with packages and models of the world.
    packages: &'static [&'static str],
    /// Start in the world: x, y \[m\], yaw \[rad\].
    pub(super) start: &'static str,
    /// Goals of the drive that maps, in the world.
    pub(super) tour: &'static [&'static str],
}

impl Course {
    pub(super) fn file(&self, shared: &Path) -> PathBuf {
        if self.is_shared { shared.join(self.file) } else { root().join(self.file) }
    }

    pub(super) fn packages(&self, shared: &Path) -> Vec<PathBuf> {
        self.packages.iter().map(|folder| shared.join(folder)).collect()
    }
}

pub(super) const ALL: [Course; 3] = [
    Course {
        name: "house",
        file: "worlds/house.sdf",
        is_shared: false,
        packages: &[],
        start: "0,0,0",
        tour: &[
            "2,0,0",
            "4.5,0,0",
            "4.5,1.6,1.57",
            "3.2,-2,-1.57",
            "0.5,-2.4,-1.57",
            "0.9,1.5,1.57",
            "-1.2,3.2,3.14",
            "-1.2,1.6,-1.57",
            "-3.2,0,-1.57",
            "-2.6,-2,-1.57",
            "0,0,0",
        ],
    },
    Course {
        name: "sandbox",
        file: "corpus/nav2_minimal_turtlebot_simulation/nav2_minimal_tb3_sim/worlds/tb3_sandbox.sdf.xacro",
        is_shared: true,
        packages: &["corpus/nav2_minimal_turtlebot_simulation"],
        start: "-2,-0.5,0",
        tour: &[
            "-0.55,-0.55,0",
            "0.55,-0.55,0",
            "1.8,0.5,1.57",
            "0.55,1.8,3.14",
            "-0.55,0.55,3.14",
            "-2,-0.5,3.14",
        ],
    },
    Course {
        name: "demo room",
        file: "worlds/demo_room.sdf",
        is_shared: false,
        packages: &[],
        start: "0,0,0",
        tour: &["-1,1.8,1.57", "1,-2,0", "3.6,-1,0", "4.8,1.5,1.57", "4.8,-2,-1.57", "0,0,3.14"],
    },
];
