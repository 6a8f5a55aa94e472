//! Parameters of a SLAM method, from files of `slam_toolbox` and `slam_gmapping` and from the
//! command line.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use periplus_nav_nodes::slam_toolbox::{Written, in_file};
use periplus_params::{Given, ParamValues};
use periplus_slam::Method;
use periplus_slam::tables::{self, GmappingParams, SlamToolboxParams};

use super::error::LogMappingError;
use super::request::LogMappingRequest;
use crate::files;
use crate::scan_log::LogSelection;

/// Parameters with their findings.
pub(super) struct SlamParameters {
    pub(super) method: Method,
    pub(super) values: ParamValues,
    pub(super) diagnostics: Diagnostics,
    pub(super) sources: SourceMap,
}

impl SlamParameters {
    /// Reads parameters in order of precedence: dedicated options, `-p`, the file.
    pub(super) fn read(request: &LogMappingRequest) -> Result<Self, LogMappingError> {
        let mut sources = SourceMap::new();
        let mut diagnostics = Diagnostics::new();
        let mut layers: Vec<Vec<Written>> = Vec::new();
        // Method of the node whose parameters the file has.
        let mut named = None;
        if let Some(path) = &request.params_file {
            let text = files::text(path)?;
            let file = sources.add(path.display().to_string(), text);
            match periplus_yaml::parse(file, &sources) {
                Ok(Some(tree)) => {
                    let found = in_file(&tree, request.method, &mut diagnostics);
                    named = found.method;
                    layers.push(found.written);
                }
                Ok(None) => diagnostics.push(
                    Diagnostic::warning("no-parameters", "the file has no parameters")
                        .at(sources.whole(file)),
                ),
                Err(wrong) => diagnostics.push(*wrong),
            }
        }
        let mut typed = Vec::new();
        for word in &request.parameters {
            typed.push(on_command_line(word, &mut sources).map_err(LogMappingError::Parameter)?);
        }
        // The last parameter of a name counts.
        typed.reverse();
        let of = |layer: &[Written]| {
            tables::method_of(&layer.iter().map(Written::given).collect::<Vec<_>>())
        };
        let told = request.method.or_else(|| of(&typed)).or(named);
        let method = told.or_else(|| layers.iter().find_map(|it| of(it))).unwrap_or_default();
        layers.push(typed);
        let table = method.table();
        layers.push(own(request, method));
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

    /// Topics and frames of the log: those of the request first, then parameters.
    pub(super) fn input(&self, requested: &LogSelection) -> LogSelection {
        let given = |name: &str| {
            self.values.table().find(name)?;
            self.values.text(name).filter(|_| self.values.is_given(name))
        };
        let usual = LogSelection::default().odom_frame;
        let odom_frame = given("odom_frame").filter(|_| requested.odom_frame == usual);
        LogSelection {
            odom_frame: odom_frame.unwrap_or_else(|| requested.odom_frame.clone()),
            preferred_topic: given("scan_topic"),
            preferred_base: given("base_frame"),
            ..requested.clone()
        }
    }

    /// Scan interval: every Nth scan is used.
    pub(super) fn every(&self) -> usize {
        match self.method {
            Method::Graph => SlamToolboxParams::from_values(&self.values).throttle_scans,
            Method::Gmapping => GmappingParams::from_values(&self.values).throttle_scans,
        }
    }
}

/// Values of dedicated options, by the parameter names of the method.
fn own(request: &LogMappingRequest, method: Method) -> Vec<Written> {
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
    give("resolution", "delta", request.resolution_m.map(|it| it.to_string()));
    give("max_laser_range", "maxUrange", request.range_max_m.map(|it| it.to_string()));
    give("do_loop_closing", "", request.is_without_loops.then(|| "false".to_owned()));
    give("", "random_seed", request.seed.map(|it| it.cast_signed().to_string()));
    give("", "threads", request.threads.map(|it| it.to_string()));
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
    // `node:name:=value` names the node, and there is only one.
    let name_from = name.rfind(':').map_or(0, |at| at + 1);
    Ok(Written {
        name: name[name_from..].to_owned(),
        text: text.trim_matches(['"', '\'']).to_owned(),
        name_origin: at(name_from, name.len()),
        origin: at(name.len() + 2, word.len()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_has_a_place_too() {
        let mut sources = SourceMap::new();
        let one = on_command_line("slam:particles:=8", &mut sources).unwrap();
        assert_eq!((one.name.as_str(), one.text.as_str()), ("particles", "8"));
        assert!(on_command_line("particles=8", &mut sources).is_err());
    }
}
