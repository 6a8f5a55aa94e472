//! Typed parameters of plugins.

use periplus_diagnostics::Diagnostics;
use periplus_params::{Given, ParamValues};
use periplus_scene::{Element, Plugin};

use crate::{Family, PluginContext, PluginSpec, RosSettings, recognise};

/// Interpreted plugin.
#[derive(Clone, Debug)]
pub struct InterpretedPlugin {
    /// Specification of the plugin.
    pub known: &'static PluginSpec,
    /// Its parameters, with defaults.
    pub values: ParamValues,
    /// Settings of its ROS node.
    pub ros: RosSettings,
}

/// Reads the parameters of a known plugin. Unreadable values are errors and replaced by defaults. Unknown
/// parameters are skipped: [`crate::lint`] reports them.
#[must_use]
pub fn interpret(
    plugin: &Plugin,
    context: &PluginContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<InterpretedPlugin> {
    let known = recognise(plugin, context)?;
    let table = &known.table;
    let given = plugin.content.iter().filter(|element| table.find(&element.name).is_some());
    let values = table.check(given.map(given_by), plugin.origin.0, diagnostics);
    let ros = match known.family {
        Family::ClassicRos1 => RosSettings::ros1(plugin),
        Family::ClassicRos2 | Family::Classic | Family::Gz => RosSettings::read(plugin),
    };
    Some(InterpretedPlugin { known, values, ros })
}

pub(crate) fn given_by(element: &Element) -> Given<'_> {
    Given {
        name: &element.name,
        text: element.text(),
        name_origin: element.name_origin(),
        origin: element.text_origin(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::plugin;

    fn interpret_alone(text: &str) -> InterpretedPlugin {
        let mut diagnostics = Diagnostics::new();
        let read = interpret(&plugin(text), &PluginContext::NOWHERE, &mut diagnostics).unwrap();
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        read
    }

    #[test]
    fn the_library_and_the_parameters_tell_the_family() {
        let family = |text: &str| interpret_alone(text).known.family;
        let ros1 = "<plugin name='d' filename='libgazebo_ros_diff_drive.so'>
                      <leftJoint>l</leftJoint></plugin>";
        assert_eq!(family(ros1), Family::ClassicRos1);
        let ros2 = "<plugin name='d' filename='libgazebo_ros_diff_drive.so'>
                      <left_joint>l</left_joint><right_joint>r</right_joint></plugin>";
        assert_eq!(family(ros2), Family::ClassicRos2);
        // ROS 1 parameters that are often left in ROS 2 files.
        let carried = "<plugin name='c' filename='libgazebo_ros_camera.so'>
                         <frame_name>f</frame_name><CxPrime>0</CxPrime></plugin>";
        assert_eq!(family(carried), Family::ClassicRos2);
        let silent = "<plugin name='c' filename='libgazebo_ros_camera.so'/>";
        assert_eq!(family(silent), Family::ClassicRos2);
        let old = "<plugin name='ignition::gazebo::systems::Imu'
                     filename='libignition-gazebo6-imu-system.so'/>";
        assert_eq!(family(old), Family::Gz);
    }

    #[test]
    fn defaults_stand_in() {
        let read = interpret_alone(
            "<plugin name='d' filename='libgazebo_ros_diff_drive.so'>
               <ros><namespace>demo</namespace></ros>
               <left_joint>a</left_joint><left_joint>b</left_joint><right_joint>c</right_joint>
               <wheel_separation>0.4</wheel_separation></plugin>",
        );
        assert_eq!(read.values.texts("left_joint"), ["a", "b"]);
        assert_eq!(read.values.numbers("wheel_separation"), [0.4]);
        assert_eq!(read.values.numbers("wheel_diameter"), [0.15]);
        assert_eq!(read.values.flag("publish_odom"), Some(false));
        assert_eq!(read.ros.namespace, "/demo");
    }

    #[test]
    fn an_unknown_plugin_is_not_interpreted() {
        let strange = plugin("<plugin name='x' filename='libmine.so'/>");
        assert!(interpret(&strange, &PluginContext::NOWHERE, &mut Diagnostics::new()).is_none());
    }
}
