//! Whether a launch file is one of ROS 1 or of ROS 2.

use std::path::Path;

use periplus_resources::Host;

/// Whose launch file it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// `roslaunch`.
    Ros1,
    /// `ros2 launch`.
    Ros2,
}

/// Whose launch file it is. Both have `<launch>` in XML; what only one of them knows decides, and where
/// nothing does, the name: `*.launch` alone is ROS 1's.
#[must_use]
pub fn dialect(host: &dyn Host, file: &Path) -> Dialect {
    let name = file.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    if [".py", ".yaml", ".yml"].iter().any(|end| name.ends_with(end)) {
        return Dialect::Ros2;
    }
    let text = host.read(file).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let text = text.unwrap_or_default();
    let has = |words: &[&str]| words.iter().any(|word| text.contains(word));
    if has(&[
        " exec=",
        "$(var ",
        "$(find-pkg-",
        "push-ros-namespace",
        "push_ros_namespace",
        "<let ",
    ]) {
        Dialect::Ros2
    } else if has(&[" type=", "$(arg ", "$(find ", "<rosparam", " ns="])
        // Only there a parameter may be outside of nodes.
        || (has(&["<param"]) && !has(&["<node", "<composable"]))
        || name.ends_with(".launch")
    {
        Dialect::Ros1
    } else {
        Dialect::Ros2
    }
}
