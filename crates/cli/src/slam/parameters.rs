//! Parameters for a method of mapping: from files as `slam_toolbox` and `slam_gmapping` have them, and
//! from the command line.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap, Span};
use periplus_host::Machine;
use periplus_params::{Given, Values};
use periplus_resources::Host as _;
use periplus_slam::{Method, tables};
use periplus_yaml::{Node, Value};

use super::options::SlamOptions;
use crate::log::LogOptions;

/// Names under which nodes that make maps have their parameters in files.
const NODES: [&str; 7] =
    ["slam_toolbox", "slam_gmapping", "gmapping", "turtlebot3_slam_gmapping", "slam", "**", "*"];
/// Namespaces around a node nest no deeper.
const DEEPEST: usize = 4;

/// What parameters say, and what is wrong with them.
pub(super) struct Parameters {
    pub(super) method: Method,
    pub(super) values: Values,
    pub(super) diagnostics: Diagnostics,
    pub(super) sources: SourceMap,
}

/// A parameter as somebody wrote it.
struct Written {
    name: String,
    text: String,
    name_origin: Origin,
    origin: Origin,
}

impl Written {
    fn given(&self) -> Given<'_> {
        Given {
            name: &self.name,
            text: self.text.as_str().into(),
            name_origin: self.name_origin,
            origin: self.origin,
        }
    }
}

impl Parameters {
    /// Reads what the options name: flags of their own win, then `-p`, then the file. In words why it cannot be.
    pub(super) fn read(options: &SlamOptions) -> Result<Self, String> {
        let mut sources = SourceMap::new();
        let mut diagnostics = Diagnostics::new();
        let mut layers: Vec<Vec<Written>> = Vec::new();
        if let Some(path) = &options.live.params_file {
            let bytes = Machine
                .read(path)
                .map_err(|why| format!("cannot read {}: {why}", path.display()))?;
            let text =
                String::from_utf8(bytes).map_err(|_| format!("{} is no text", path.display()))?;
            let file = sources.add(path.display().to_string(), text);
            match periplus_yaml::parse(file, &sources) {
                Ok(Some(tree)) => {
                    layers.push(in_file(&tree, sources.whole(file), &mut diagnostics));
                }
                Ok(None) => diagnostics.push(
                    Diagnostic::warning("no-parameters", "there are no parameters in here")
                        .at(sources.whole(file)),
                ),
                Err(wrong) => diagnostics.push(*wrong),
            }
        }
        let mut typed = Vec::new();
        for word in &options.parameters {
            typed.push(on_command_line(word, &mut sources)?);
        }
        // The last one of a name counts.
        typed.reverse();
        layers.push(typed);
        let method = options.method.unwrap_or_else(|| {
            let all: Vec<Given<'_>> = layers.iter().flatten().map(Written::given).collect();
            tables::method_of(&all).unwrap_or_default()
        });
        let table = method.table();
        layers.push(own(options, method));
        let canonical = |name: &str| table.find(name).map(|it| it.name);
        let mut counts: Vec<Given<'_>> = Vec::new();
        for layer in layers.iter().rev() {
            let stronger = counts.len();
            for one in layer {
                let is_set = counts[..stronger].iter().any(|other| {
                    canonical(other.name).is_some() && canonical(other.name) == canonical(&one.name)
                });
                if !is_set {
                    counts.push(one.given());
                }
            }
        }
        let values = table.check(counts, None, &mut diagnostics);
        for finding in tables::conflicts(&values).into_iter().chain(tables::idle(&values)) {
            diagnostics.push(finding);
        }
        Ok(Self { method, values, diagnostics, sources })
    }

    /// Where to find what in the log: flags of their own win, then what the parameters say.
    pub(super) fn input(&self, flags: &LogOptions) -> LogOptions {
        let told = |name: &str| {
            self.values.table().find(name)?;
            self.values.text(name).filter(|_| self.values.is_given(name))
        };
        let odom_frame = told("odom_frame").filter(|_| flags.odom_frame == "odom");
        LogOptions {
            odom_frame: odom_frame.unwrap_or_else(|| flags.odom_frame.clone()),
            told_topic: told("scan_topic"),
            told_base: told("base_frame"),
            ..flags.clone()
        }
    }

    /// Every so manieth scan is used.
    pub(super) fn every(&self) -> usize {
        let every = self.values.integer("throttle_scans").unwrap_or(1);
        usize::try_from(every).unwrap_or(1).max(1)
    }
}

/// What flags of their own say, by the names that the method has for it.
fn own(options: &SlamOptions, method: Method) -> Vec<Written> {
    let mut all = Vec::new();
    let mut give = |graph: &str, gmapping: &str, text: Option<String>| {
        let name = match method {
            Method::Graph => graph,
            Method::Gmapping => gmapping,
        };
        if let Some(text) = text.filter(|_| !name.is_empty()) {
            let (name_origin, origin) = (Origin::default(), Origin::default());
            all.push(Written { name: name.to_owned(), text, name_origin, origin });
        }
    };
    give("resolution", "delta", options.resolution.map(|it| it.to_string()));
    give("max_laser_range", "maxUrange", options.max_range.map(|it| it.to_string()));
    give("do_loop_closing", "", options.no_loops.then(|| "false".to_owned()));
    give("", "random_seed", options.seed.map(|it| it.cast_signed().to_string()));
    give("", "threads", options.threads.map(|it| it.to_string()));
    all
}

/// `name:=value`.
fn on_command_line(word: &str, sources: &mut SourceMap) -> Result<Written, String> {
    let Some((name, text)) = word.split_once(":=").filter(|(name, _)| !name.is_empty()) else {
        return Err(format!("`-p {word}`: write a parameter as `name:=value`"));
    };
    let file = sources.add("-p", word);
    let whole = sources.whole(file);
    let at = |from: usize, to: usize| Origin(Some(whole.part(from, to)));
    // `node:name:=value` is for that node, and there is one.
    let name_from = name.rfind(':').map_or(0, |at| at + 1);
    Ok(Written {
        name: name[name_from..].to_owned(),
        text: text.trim_matches(['"', '\'']).to_owned(),
        name_origin: at(name_from, name.len()),
        origin: at(name.len() + 2, word.len()),
    })
}

/// The parameters in a file: those below `ros__parameters` of a node that makes maps; in files of
/// ROS 1 those of such a node, or all.
fn in_file(tree: &Node, whole: Span, diagnostics: &mut Diagnostics) -> Vec<Written> {
    let mut sections = Vec::new();
    let mut others = Vec::new();
    collect(tree, &mut sections, &mut others, 0);
    if sections.is_empty() && !others.is_empty() {
        diagnostics.push(
            Diagnostic::warning("no-parameters", "no node in here makes maps")
                .at(whole)
                .note(format!("there are parameters for {}", others.join(", ")))
                .help("write them below `slam_toolbox:` or `slam_gmapping:`, or below `/**:`"),
        );
    }
    if sections.is_empty() && others.is_empty() {
        let named = NODES.iter().find_map(|name| tree.get(name));
        sections.push(named.filter(|it| it.entries().is_some()).unwrap_or(tree));
    }
    let mut all = Vec::new();
    for section in sections {
        for (key, value) in section.entries().unwrap_or_default() {
            let (Some(name), Some(text)) = (key.text(), text(value)) else { continue };
            all.push(Written {
                name: name.to_owned(),
                text,
                name_origin: key.span.into(),
                origin: value.span.into(),
            });
        }
    }
    all
}

/// A value as it would be typed; none for what is no value of a parameter.
fn text(value: &Node) -> Option<String> {
    match &value.value {
        Value::Scalar { text, .. } => Some(text.clone()),
        Value::List(items) => {
            let items: Option<Vec<&str>> = items.iter().map(Node::text).collect();
            Some(items?.join(" "))
        }
        Value::Map(_) => None,
    }
}

/// Finds what stands below `ros__parameters`, of nodes that make maps and of others.
fn collect<'a>(at: &'a Node, found: &mut Vec<&'a Node>, others: &mut Vec<String>, depth: usize) {
    let Some(entries) = at.entries().filter(|_| depth < DEEPEST) else { return };
    for (key, value) in entries {
        let Some(key) = key.text() else { continue };
        let name = key.trim_start_matches('/').rsplit('/').next().unwrap_or(key);
        match value.get("ros__parameters") {
            Some(parameters) if NODES.contains(&name) => found.push(parameters),
            Some(_) => others.push(format!("`{name}`")),
            None => collect(value, found, others, depth + 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Vec<String>, Vec<String>) {
        let mut sources = SourceMap::new();
        let file = sources.add("file.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).unwrap().unwrap();
        let mut diagnostics = Diagnostics::new();
        let written = in_file(&tree, sources.whole(file), &mut diagnostics);
        let told = diagnostics.iter().map(|it| it.message.clone()).collect();
        (written.into_iter().map(|it| format!("{}={}", it.name, it.text)).collect(), told)
    }

    #[test]
    fn parameters_are_found_as_ros_2_and_ros_1_write_them() {
        let one = vec!["resolution=0.1".to_owned()];
        let ros2 = "slam_toolbox:\n  ros__parameters:\n    resolution: 0.1\n";
        assert_eq!(read(ros2).0, one);
        assert_eq!(read("/**:\n  ros__parameters: {resolution: 0.1}\n").0, one);
        assert_eq!(
            read("robot:\n  slam_toolbox:\n    ros__parameters: {resolution: 0.1}\n").0,
            one
        );
        assert_eq!(read("slam_gmapping:\n  delta: 0.1\n").0, ["delta=0.1"]);
        assert_eq!(read("delta: 0.1\nmap_start_pose: [1.0, 2, 0]\n").0.len(), 2);
        let (none, told) = read("amcl:\n  ros__parameters: {alpha1: 0.1}\n");
        assert!(none.is_empty());
        assert_eq!(told, ["no node in here makes maps"]);
    }

    #[test]
    fn the_command_line_has_a_place_too() {
        let mut sources = SourceMap::new();
        let one = on_command_line("slam:particles:=8", &mut sources).unwrap();
        assert_eq!((one.name.as_str(), one.text.as_str()), ("particles", "8"));
        assert!(on_command_line("particles=8", &mut sources).is_err());
    }
}
