//! State of the mapper on `/diagnostics`: warnings and contradictions of the map as long as they
//! apply.

use periplus_graph::{GraphError, Level, Node, Publisher, Qos};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue};
use periplus_msgs::std_msgs::Header;
use periplus_slam::{MapContradiction, Remark, RemarkKind, ScanOutcome};

use crate::slam_toolbox::engine::Engine;
use crate::slam_toolbox::markers;
use crate::slam_toolbox::node::SlamNode;

/// Period of publication \[ns\].
pub(crate) const EVERY_NS: i64 = 1_000_000_000;
/// Maximum number of contradictions listed with values, worst first.
const MOST_PLACES: usize = 20;
/// Weight of the newest scan in the moving average of scans without a match, and the fraction above
/// which a map is unreliable: a dozen scans in a row.
const NEWEST: f64 = 0.01;
const MOST_LOST: f64 = 0.1;

/// Parts of the state that have a status each; each is always published, also without a problem.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Scans,
    Odometry,
    Mounting,
    Components,
    Contradictions,
}

impl Part {
    /// Checks available for an engine.
    const fn of_engine(engine: &Engine) -> &'static [Self] {
        match engine {
            Engine::Graph(_) => &[
                Self::Scans,
                Self::Odometry,
                Self::Mounting,
                Self::Components,
                Self::Contradictions,
            ],
            Engine::Particles(_) => {
                &[Self::Scans, Self::Odometry, Self::Mounting, Self::Components]
            }
            Engine::Localizer(_) => &[Self::Scans],
        }
    }

    fn of(kind: &RemarkKind) -> Self {
        match kind {
            RemarkKind::UnmatchedScans(_) => Self::Scans,
            RemarkKind::DistanceScale(_)
            | RemarkKind::RotationScale(..)
            | RemarkKind::OdometryInconsistent
            | RemarkKind::Corridor(_)
            | RemarkKind::NoOdometry
            | RemarkKind::OdometryStuck(_)
            | RemarkKind::OdometryJumped(_) => Self::Odometry,
            RemarkKind::ScannerYaw(_)
            | RemarkKind::ScanMirrored
            | RemarkKind::OdometryReversed
            | RemarkKind::OdometryAxesSwapped
            | RemarkKind::OdometryXNegated
            | RemarkKind::OdometryYNegated => Self::Mounting,
            RemarkKind::Kidnapped
            | RemarkKind::Disconnected(_)
            | RemarkKind::ParticlesReduced(_)
            | RemarkKind::GraphFollowed(_) => Self::Components,
            RemarkKind::Contradiction(..)
            | RemarkKind::DoubledWalls(..)
            | RemarkKind::AmbiguousClosure(..)
            | RemarkKind::UnconfirmedPath(..) => Self::Contradictions,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Scans => "scans",
            Self::Odometry => "odometry",
            Self::Mounting => "mounting",
            Self::Components => "components",
            Self::Contradictions => "contradictions",
        }
    }

    const fn fine(self) -> &'static str {
        match self {
            Self::Scans => "scans fit the map",
            Self::Odometry => "odometry and scans agree",
            Self::Mounting => "nothing is wrong with the scanner's mounting and odometry's axes",
            Self::Components => "the map is one component",
            Self::Contradictions => "all passes through the same area agree",
        }
    }
}

/// Publishes the state, and logs each contradiction once.
pub(crate) struct SlamHealth {
    diagnostics: Publisher<DiagnosticArray>,
    /// Times of scans in contradictions that are logged \[ns\].
    logged_ns: Vec<(i64, i64)>,
    /// Contradictions published last.
    drawn: Vec<MapContradiction>,
    /// Moving average of the fraction of scans without a match.
    lost_ratio: f64,
}

impl SlamHealth {
    pub(crate) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            diagnostics: node.publisher("/diagnostics", Qos::reliable(10))?,
            logged_ns: Vec::new(),
            drawn: Vec::new(),
            lost_ratio: 0.0,
        })
    }

    /// Resets the state for a new map.
    pub(crate) fn forget(&mut self) {
        self.logged_ns.clear();
        self.lost_ratio = 0.0;
    }

    /// Publishes the contradictions again, if any.
    pub(crate) fn draw_again(&self, draw: impl FnOnce(&[MapContradiction])) {
        if !self.drawn.is_empty() {
            draw(&self.drawn);
        }
    }

    /// Counts a scan.
    pub(crate) fn count(&mut self, taken: ScanOutcome) {
        let lost = f64::from(u8::from(taken == ScanOutcome::NoMatch));
        self.lost_ratio += NEWEST * (lost - self.lost_ratio);
    }

    /// Returns true if a contradiction is new, and records it.
    fn is_new(&mut self, found: &MapContradiction) -> bool {
        let (from_ns, to_ns) = found.times_ns;
        let is_same = |it: &&mut (i64, i64)| it.0 <= to_ns && from_ns <= it.1;
        if let Some(logged) = self.logged_ns.iter_mut().find(is_same) {
            *logged = (logged.0.min(from_ns), logged.1.max(to_ns));
            return false;
        }
        self.logged_ns.push((from_ns, to_ns));
        true
    }
}

impl SlamNode {
    /// Publishes the state, logs contradictions that are new, and draws them when they have changed.
    pub(crate) fn publish_health(&mut self, node: &Node) {
        let now_ns = node.now_ns();
        let mapper = self.engine.as_ref().map(Engine::mapper).filter(|_| node.is_active());
        let contradictions = mapper.map_or_else(Vec::new, periplus_slam::Mapper::contradictions);
        let remarks = mapper.map(periplus_slam::Mapper::current_remarks);
        for found in &contradictions {
            if self.health.is_new(found) {
                let words = format!("{}; {}; {ADVICE}", found.remark(), self.passes(found));
                node.log(Level::Warn, words);
            }
        }
        if self.health.drawn != contradictions {
            self.draw_contradictions(now_ns, &contradictions);
            self.health.drawn.clone_from(&contradictions);
        }
        let mut status = vec![self.whole(node)];
        if let Some(mut remarks) = remarks {
            let share = self.health.lost_ratio;
            if share > MOST_LOST {
                remarks.push(Remark { time_ns: now_ns, kind: RemarkKind::UnmatchedScans(share) });
            }
            let parts = self.engine.as_ref().map_or(&[][..], Part::of_engine);
            for &part in parts {
                let own: Vec<&Remark> =
                    remarks.iter().filter(|it| Part::of(&it.kind) == part).collect();
                status.push(match part {
                    Part::Contradictions => self.contradicted(node, &contradictions),
                    _ => self.part(node, part, &own),
                });
            }
        }
        let array = DiagnosticArray { header: Header::at(now_ns, ""), status };
        self.health.diagnostics.publish(array);
    }

    /// Publishes the contradictions; an empty message after the last one was resolved.
    pub(crate) fn draw_contradictions(&self, now_ns: i64, found: &[MapContradiction]) {
        let Some(outputs) = &self.outputs else { return };
        outputs.publish_contradictions(|| {
            let poses =
                self.engine.as_ref().and_then(Engine::graph).map_or(&[][..], |it| it.poses());
            let texts = found.iter().map(|it| self.passes(it)).collect::<Vec<_>>();
            markers::contradictions(found, &texts, poses, &self.names().map, now_ns)
        });
    }

    /// The node as a whole.
    fn whole(&self, node: &Node) -> DiagnosticStatus {
        let status = self.status();
        let counts = status.counts;
        let values = vec![
            pair("scans", counts.scans),
            pair("kept scans", counts.kept),
            pair("scans that did not fit", counts.lost),
            pair("scans without transforms", status.dropped),
            pair("scans left out for newer ones", status.left_out),
            pair("memory of the map [bytes]", status.size),
        ];
        let (level, message) = if !node.is_active() {
            let message = "waits until a client configures and activates it";
            (DiagnosticStatus::WARN, message.to_owned())
        } else if let Some(trouble) = status.trouble {
            (DiagnosticStatus::ERROR, trouble)
        } else if self.is_paused {
            (DiagnosticStatus::OK, "paused: new scans are left out".to_owned())
        } else {
            (DiagnosticStatus::OK, format!("{} scans, {} kept", counts.scans, counts.kept))
        };
        told(node, "mapping", level, message, values)
    }

    fn part(&self, node: &Node, part: Part, remarks: &[&Remark]) -> DiagnosticStatus {
        let mut messages: Vec<String> = remarks.iter().map(ToString::to_string).collect();
        let mut values: Vec<KeyValue> =
            remarks.iter().map(|it| pair("noticed [s]", seconds(it.time_ns))).collect();
        let mut is_warning = remarks.iter().any(|it| it.is_warning());
        if let Some(correction) = self.correction.as_ref().filter(|_| part == Part::Mounting) {
            is_warning = true;
            messages.insert(0, format!("corrected: {}; {SET_RIGHT}", correction.cure.remedy()));
            values.push(pair("corrected [s]", seconds(correction.time_ns)));
        }
        let level = if is_warning { DiagnosticStatus::WARN } else { DiagnosticStatus::OK };
        let message =
            if messages.is_empty() { part.fine().to_owned() } else { messages.join("; ") };
        told(node, part.name(), level, message, values)
    }

    fn contradicted(&self, node: &Node, found: &[MapContradiction]) -> DiagnosticStatus {
        let part = Part::Contradictions;
        let mut sorted: Vec<&MapContradiction> = found.iter().collect();
        sorted.sort_by(|a, b| a.agreeing_ratio.total_cmp(&b.agreeing_ratio));
        let Some(worst) = sorted.first() else {
            return told(node, part.name(), DiagnosticStatus::OK, part.fine().to_owned(), vec![]);
        };
        let others = match found.len() - 1 {
            0 => String::new(),
            1 => "; there is one more".to_owned(),
            more => format!("; there are {more} more"),
        };
        let message = format!("{}; {}; {ADVICE}{others}", worst.remark(), self.passes(worst));
        let span =
            |(from_ns, to_ns): (i64, i64)| format!("{} {}", seconds(from_ns), seconds(to_ns));
        let values = sorted.iter().take(MOST_PLACES).enumerate().flat_map(|(place, it)| {
            let pose = it.map_from_base;
            let key = |what: &str| format!("{} {what}", place + 1);
            [
                pair(&key("position [m]"), format!("{:.2} {:.2}", pose.x_m, pose.y_m)),
                pair(&key("agreeing [%]"), format!("{:.0}", 100.0 * it.agreeing_ratio)),
                pair(&key("pass [s]"), span(it.times_ns)),
                pair(&key("earlier pass [s]"), span(it.earlier_times_ns)),
            ]
        });
        told(node, part.name(), DiagnosticStatus::WARN, message, values.collect())
    }

    /// Times of both passes, since the map began.
    pub(crate) fn passes(&self, found: &MapContradiction) -> String {
        let after = |time_ns: i64| (time_ns - self.began_ns.unwrap_or(time_ns)) as f64 * 1e-9;
        format!(
            "the passes were {:.0} s and {:.0} s after the map began",
            after(found.earlier_times_ns.0),
            after(found.times_ns.0)
        )
    }
}

/// Advice for a contradiction.
const ADVICE: &str = "look at the red marker in the map: drive there once more, and when it stays and \
                      nothing has moved there, do not use the map";
/// Advice for a fault that is corrected.
pub(crate) const SET_RIGHT: &str = "set the scanner's transform or the drive's odometry right, since \
                                    other nodes get the data as it is";

fn told(
    node: &Node,
    what: &str,
    level: u8,
    message: String,
    values: Vec<KeyValue>,
) -> DiagnosticStatus {
    DiagnosticStatus {
        level,
        name: format!("{}: {what}", node.full_name().trim_start_matches('/')),
        message,
        hardware_id: String::new(),
        values,
    }
}

fn pair(key: &str, value: impl ToString) -> KeyValue {
    KeyValue { key: key.to_owned(), value: value.to_string() }
}

fn seconds(time_ns: i64) -> String {
    format!(
        "{}.{:03}",
        time_ns.div_euclid(1_000_000_000),
        time_ns.rem_euclid(1_000_000_000) / 1_000_000
    )
}
