//! Normalized names of libraries.

/// Library that a `filename` refers to, without folders, `lib`, `.so` and versions, with its current name:
/// `libignition-gazebo6-diff-drive-system.so` is `gz-sim-diff-drive-system`.
#[must_use]
pub fn library_id(filename: &str) -> String {
    let name = filename.trim().rsplit(['/', '\\']).next().unwrap_or_default();
    let name = name.split(".so").next().unwrap_or(name);
    let name = name.strip_suffix(".dylib").or_else(|| name.strip_suffix(".dll")).unwrap_or(name);
    let bare = name.strip_prefix("lib").unwrap_or(name);
    for (old, today) in [("ignition-gazebo", "gz-sim"), ("gz-sim", "gz-sim")] {
        let Some(rest) = bare.strip_prefix(old) else { continue };
        let rest = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        if let Some(rest) = rest.strip_prefix('-') {
            return format!("{today}-{}", rest.replace('_', "-"));
        }
    }
    match bare {
        // Name in Fortress of the current gz_ros2_control.
        "ign_ros2_control-system" => "gz_ros2_control-system".into(),
        _ => bare.to_owned(),
    }
}

/// Class that a `name` refers to, without its namespace.
pub(crate) fn class_id(name: &str) -> &str {
    name.trim().rsplit("::").next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::library_id;

    #[test]
    fn three_generations_of_names_are_one() {
        for name in [
            "gz-sim-diff-drive-system",
            "libgz-sim-diff-drive-system.so",
            "libgz-sim8-diff-drive-system.so",
            "libgz-sim8-diff-drive-system.so.8.1.0",
            "ignition-gazebo-diff-drive-system",
            "libignition-gazebo6-diff-drive-system.so",
            "/opt/lib/libgz-sim-diff-drive-system.so",
        ] {
            assert_eq!(library_id(name), "gz-sim-diff-drive-system", "{name}");
        }
        assert_eq!(library_id("libgazebo_ros_imu.so"), "gazebo_ros_imu");
        assert_eq!(library_id("MinimalScene"), "MinimalScene");
        assert_eq!(library_id("libMinimalScene.so"), "MinimalScene");
        assert_eq!(library_id(""), "");
    }
}
