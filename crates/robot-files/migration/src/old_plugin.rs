//! Plugin of Gazebo Classic as written, possibly with expressions of xacro in its values.

use std::borrow::Cow;

use periplus_diagnostics::Diagnostics;
use periplus_plugin_specs::{
    Family, InterpretedPlugin, PluginContext, PluginSpec, interpret, library_id, recognise,
};
use periplus_scene::Plugin;
use periplus_xml::Element;

use crate::template;

/// Elements around a plugin.
#[derive(Clone, Copy, Default)]
pub(crate) struct Surroundings<'a> {
    /// Innermost `<world>`.
    pub(crate) world: Option<&'a Element>,
    /// Innermost `<model>`, or the `<robot>`.
    pub(crate) model: Option<&'a Element>,
    /// Name of the innermost link, or `reference` of the `<gazebo>` element.
    pub(crate) reference: Option<&'a str>,
    /// `<gazebo>` of a URDF.
    pub(crate) gazebo: Option<&'a Element>,
    /// Innermost `<sensor>`.
    pub(crate) sensor: Option<&'a Element>,
    /// True in a `<robot>`.
    pub(crate) is_urdf: bool,
    /// True in an element of xacro that runs on a condition.
    pub(crate) is_conditional: bool,
    /// Macro whose argument contains the element.
    pub(crate) macro_name: Option<&'a str>,
}

/// Plugin of Gazebo Classic.
pub(crate) struct OldPlugin<'a> {
    pub(crate) surroundings: Surroundings<'a>,
    pub(crate) plugin: Plugin,
    /// Specification, if the library is known.
    pub(crate) spec: Option<&'static PluginSpec>,
    interpreted: Option<InterpretedPlugin>,
    /// True if parameters are inside of `<xacro:if>`.
    pub(crate) has_conditions: bool,
}

/// Value of a flag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Flag {
    Yes,
    No,
    /// An expression of xacro.
    Unknown(String),
}

impl<'a> OldPlugin<'a> {
    /// Reads a `<plugin>`; `ros` is the ROS version that the other plugins of the robot determine.
    pub(crate) fn read(
        element: &'a Element,
        surroundings: Surroundings<'a>,
        ros: Option<Family>,
    ) -> Self {
        let filename = element.value("filename").unwrap_or_default();
        Self::read_as(element, filename, surroundings, ros)
    }

    /// Reads a `<plugin>` whose file name is an expression with this value.
    pub(crate) fn read_as(
        element: &'a Element,
        filename: &str,
        surroundings: Surroundings<'a>,
        ros: Option<Family>,
    ) -> Self {
        let mut content = Vec::new();
        let mut has_conditions = false;
        collect(element, &mut content, &mut has_conditions);
        let mut plugin = Plugin {
            name: element.value("name").unwrap_or_default().to_owned(),
            filename: filename.to_owned(),
            content,
            origin: element.origin,
        };
        let context = PluginContext { ros, ..PluginContext::NOWHERE };
        let spec = recognise(&plugin, &context);
        // Cameras of ROS 2 are named by their sensor unless the plugin names them.
        let name = "camera_name";
        if let (Some(spec), Some(sensor)) = (spec, surroundings.sensor)
            && spec.family == Family::ClassicRos2
            && spec.table.find(name).is_some()
            && plugin.value(name).is_none_or(|value| value.is_empty())
        {
            let sensor = sensor.value("name").unwrap_or_default();
            plugin.content.push(Element::new(name).with_text(sensor));
        }
        // Values that are expressions are findings of `check` on the expanded robot, not of this one.
        let interpreted = interpret(&plugin, &context, &mut Diagnostics::new());
        Self { surroundings, plugin, spec, interpreted, has_conditions }
    }

    /// Name of the library without `lib` and `.so`.
    pub(crate) fn library(&self) -> String {
        library_id(&self.plugin.filename)
    }

    pub(crate) fn is_ros1(&self) -> bool {
        self.spec.is_some_and(|spec| spec.family == Family::ClassicRos1)
    }

    /// Text of the first parameter with one of these names; `None` if it is empty or missing.
    pub(crate) fn text(&self, names: &[&str]) -> Option<String> {
        names
            .iter()
            .filter(|name| self.reads(name))
            .find_map(|name| self.plugin.value(name))
            .map(Cow::into_owned)
            .filter(|text| !text.is_empty())
    }

    /// True if the plugin reads a parameter: names of the other ROS version have no effect.
    fn reads(&self, name: &str) -> bool {
        self.spec.is_none_or(|spec| spec.open || spec.table.find(name).is_some())
    }

    /// Texts of all parameters of a name.
    pub(crate) fn texts(&self, name: &str) -> Vec<String> {
        let is_read = self.reads(name);
        let content = self.plugin.content.iter();
        let named = content.filter(|element| is_read && element.name == name);
        named.map(|element| element.text().into_owned()).collect()
    }

    /// Value of a flag.
    pub(crate) fn flag(&self, names: &[&str], default: bool) -> Flag {
        match self.text(names).map(|text| template::flag(&text)) {
            Some(Some(true)) => Flag::Yes,
            Some(Some(false)) => Flag::No,
            Some(None) => Flag::Unknown(self.text(names).unwrap_or_default()),
            None if default => Flag::Yes,
            None => Flag::No,
        }
    }

    /// Name on ROS of a topic of the plugin: with namespace and remappings.
    pub(crate) fn ros_topic(&self, inside: &str) -> String {
        let full = match &self.interpreted {
            Some(interpreted) => interpreted.ros.resolve(inside),
            None => format!("/{}", inside.trim_start_matches('/')),
        };
        template::topic(&full)
    }

    /// Name on ROS of a topic that a parameter sets.
    pub(crate) fn topic(&self, names: &[&str], default: &str) -> String {
        let given = self.text(names);
        self.ros_topic(given.as_deref().unwrap_or(default))
    }

    /// Name of a frame without a leading slash.
    pub(crate) fn frame(&self, names: &[&str]) -> Option<String> {
        self.text(names).map(|frame| frame.trim_start_matches('/').to_owned())
    }

    /// True if one of these parameters is given with another value than zero.
    pub(crate) fn is_nonzero(&self, names: &[&str]) -> bool {
        self.text(names).is_some_and(|text| {
            text.split_whitespace().any(|part| template::number(part).is_none_or(|n| n != 0.0))
        })
    }
}

fn collect(element: &Element, content: &mut Vec<Element>, has_conditions: &mut bool) {
    for child in element.elements() {
        if child.prefix() == Some("xacro") && matches!(child.local_name(), "if" | "unless") {
            *has_conditions = true;
            collect(child, content, has_conditions);
        } else {
            content.push(child.clone());
        }
    }
}
