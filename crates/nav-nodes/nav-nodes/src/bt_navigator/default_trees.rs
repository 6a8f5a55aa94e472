//! Built-in trees, under the names of Nav2's files.

use std::borrow::Cow;

use periplus_costmap::Nav2Release;

use super::simple_trees;

/// File name of the default tree of `navigate_to_pose`.
pub const NAVIGATE_TO_POSE_FILE: &str = "navigate_to_pose_w_replanning_and_recovery.xml";
/// File name of the default tree of `navigate_through_poses`.
pub const NAVIGATE_THROUGH_POSES_FILE: &str =
    "navigate_through_poses_w_replanning_and_recovery.xml";

/// File name of the tree of `navigate_to_pose` for cars; Nav2 has none.
pub const NAVIGATE_CAR_TO_POSE_FILE: &str = "navigate_car_to_pose.xml";

/// File names of the built-in trees that Nav2 has.
pub fn built_in_tree_files() -> impl Iterator<Item = &'static str> {
    [NAVIGATE_TO_POSE_FILE, NAVIGATE_THROUGH_POSES_FILE].into_iter().chain(simple_trees::FILES)
}

/// Text of a built-in tree by its file name; none for other names. Kilted has the trees of Jazzy; the tree for cars is the
/// same for all releases.
#[must_use]
pub fn built_in_tree(release: Nav2Release, file_name: &str) -> Option<Cow<'static, str>> {
    let [humble, jazzy, main] = match file_name {
        NAVIGATE_TO_POSE_FILE => [
            include_str!("trees/humble/navigate_to_pose.xml"),
            include_str!("trees/jazzy/navigate_to_pose.xml"),
            include_str!("trees/main/navigate_to_pose.xml"),
        ],
        NAVIGATE_THROUGH_POSES_FILE => [
            include_str!("trees/humble/navigate_through_poses.xml"),
            include_str!("trees/jazzy/navigate_through_poses.xml"),
            include_str!("trees/main/navigate_through_poses.xml"),
        ],
        NAVIGATE_CAR_TO_POSE_FILE => {
            return Some(Cow::Borrowed(include_str!("trees/navigate_car_to_pose.xml")));
        }
        other => return simple_trees::text(release, other).map(Cow::Owned),
    };
    Some(Cow::Borrowed(match release {
        Nav2Release::Humble => humble,
        Nav2Release::EarlyJazzy | Nav2Release::Jazzy | Nav2Release::Kilted => jazzy,
        Nav2Release::Main => main,
    }))
}
