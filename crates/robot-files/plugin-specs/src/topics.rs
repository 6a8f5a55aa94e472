//! Full names of the topics of a plugin.

use crate::{Family, InterpretedPlugin, PluginContext, PluginTopic, TopicDirection};

/// Topic with its full name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResolvedTopic {
    /// Direction of the topic.
    pub flow: TopicDirection,
    /// Name inside the plugin, before remapping.
    pub inside: String,
    /// Full name.
    pub name: String,
}

/// Returns the topics of a plugin with remappings, namespaces and parameters applied.
#[must_use]
pub fn topics(plugin: &InterpretedPlugin, context: &PluginContext<'_>) -> Vec<ResolvedTopic> {
    let on = |topic: &&PluginTopic| {
        topic.when.is_none_or(|parameter| plugin.values.flag(parameter) == Some(true))
    };
    plugin.known.topics.iter().filter(on).map(|topic| resolve(topic, plugin, context)).collect()
}

fn resolve(
    topic: &PluginTopic,
    plugin: &InterpretedPlugin,
    context: &PluginContext<'_>,
) -> ResolvedTopic {
    let set = topic
        .set_by
        .filter(|parameter| plugin.values.is_given(parameter))
        .and_then(|parameter| plugin.values.text(parameter))
        .filter(|name| !name.is_empty());
    // Camera topics of ROS 1 are below the camera's name even if they are set.
    let inside = match (set, topic.name.split_once("}/")) {
        (Some(set), Some((before, _))) if before.starts_with('{') && !set.starts_with('/') => {
            fill(&format!("{before}}}/{set}"), plugin, context)
        }
        (Some(set), _) => set,
        (None, _) => fill(topic.name, plugin, context),
    };
    let name = match plugin.known.family {
        Family::Gz if inside.starts_with('/') => inside.clone(),
        Family::Gz => format!("/{inside}"),
        _ => plugin.ros.resolve(&inside),
    };
    ResolvedTopic { flow: topic.flow, inside, name }
}

/// Replaces `{...}` by names of the scene and values of parameters.
fn fill(template: &str, plugin: &InterpretedPlugin, context: &PluginContext<'_>) -> String {
    let mut out = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once('{') {
        out.push_str(before);
        let Some((name, behind)) = after.split_once('}') else { break };
        let value = match name {
            "model" => context.model.map(|model| model.name.clone()),
            "world" => context.world.map(|world| world.name.clone()),
            parameter => {
                plugin.values.text(parameter).filter(|text| !text.is_empty()).or_else(|| {
                    let sensor = context.sensor.filter(|_| parameter == "camera_name");
                    sensor.map(|sensor| sensor.name.clone())
                })
            }
        };
        match value {
            Some(value) => {
                out.push_str(&value);
                rest = behind;
            }
            // An unknown camera name leaves nothing, not even its slash.
            None => rest = behind.strip_prefix('/').unwrap_or(behind),
        }
    }
    out.push_str(rest);
    out
}
