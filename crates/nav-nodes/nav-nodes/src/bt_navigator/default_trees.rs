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

/// File name of the tree of `navigate_to_pose` that keeps a path while it is valid, for robots that turn in place and
/// follow their path without deviation; Nav2 has none.
pub const NAVIGATE_KEEPING_PATH_FILE: &str = "navigate_to_pose_keeping_path.xml";

/// Tree for cars.
const CAR_TREE: &str = include_str!("trees/navigate_car_to_pose.xml");

/// Recovery before which a robot other than a car turns.
const FIRST_DRIVE: &str = "<BackUp ";

/// Turn of a robot in place, as in the trees of Nav2.
const TURN: &str =
    "<Spin spin_dist=\"1.57\" error_code_id=\"{spin_error_code}\" error_msg=\"{spin_error_msg}\"/>";

/// Tree that keeps a path, with all recoveries of Nav2.
fn keeping_path() -> String {
    let tree = CAR_TREE.replace("NavigateCarToPose", "NavigateKeepingPath");
    let tree = tree.replacen(FIRST_DRIVE, &format!("{TURN}\n            {FIRST_DRIVE}"), 1);
    // The comment is about cars.
    tree.split_once("-->").map_or(tree.clone(), |(_, rest)| rest.trim_start().to_owned())
}

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
            return Some(Cow::Borrowed(CAR_TREE));
        }
        NAVIGATE_KEEPING_PATH_FILE => return Some(Cow::Owned(keeping_path())),
        other => return simple_trees::text(release, other).map(Cow::Owned),
    };
    Some(Cow::Borrowed(match release {
        Nav2Release::Humble => humble,
        Nav2Release::EarlyJazzy | Nav2Release::Jazzy | Nav2Release::Kilted => jazzy,
        Nav2Release::Main => main,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_that_keeps_a_path_turns_before_it_backs_up() {
        let tree = built_in_tree(Nav2Release::Jazzy, NAVIGATE_KEEPING_PATH_FILE).unwrap();
        assert!(tree.starts_with("<root") && !tree.contains("Car"));
        let (turn, back) = (tree.find("<Spin").unwrap(), tree.find("<BackUp").unwrap());
        assert!(turn < back && tree.matches("<Spin").count() == 1);
        assert!(tree.contains("<IsPathValid"));
    }
}
