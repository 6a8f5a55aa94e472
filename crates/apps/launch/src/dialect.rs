//! Distinction between launch files of ROS 1 and ROS 2.

use std::path::Path;

use periplus_resources::Host;

/// ROS version of a launch file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// `roslaunch`.
    Ros1,
    /// `ros2 launch`.
    Ros2,
}

/// Detects the ROS version of a launch file. Both have `<launch>` in XML; elements of only one
/// version decide, and otherwise the file name: `*.launch` is ROS 1.
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
        // ROS 1 alone allows parameters outside nodes.
        || (has(&["<param"]) && !has(&["<node", "<composable"]))
        || name.ends_with(".launch")
    {
        Dialect::Ros1
    } else {
        Dialect::Ros2
    }
}
