//! `periplus teleop`.

mod terminal;

use std::io::{self, IsTerminal as _};
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Graph, GraphError, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_msgs::std_msgs::Header;
use periplus_os::{Stopwatch, unix_ns};
use periplus_params::Given;
use periplus_ros2cli::teleop::{Keyboard, Pressed, SCREEN, TELEOP, TeleopParams, status};

use crate::arguments;
use crate::error::CliError;
use crate::run_options::LiveNetworkOptions;
use crate::terminal::diagnostics;
use terminal::RawTerminal;

/// Number of velocity lines after which the screen is printed again, as in `teleop_twist_keyboard`.
const LINES_PER_SCREEN: u32 = 15;

/// Timeout for delivering the last velocity.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

/// Longest wait for a key.
const POLL_PERIOD: Duration = Duration::from_millis(50);

/// Drive a robot with the keyboard, with the keys of `teleop_twist_keyboard`
///
/// Publishes on `cmd_vel`; `-r cmd_vel:=/demo/cmd_vel` selects another topic. `--ros-args` and the
/// parameters of `teleop_twist_keyboard` are understood.
#[derive(Debug, Args)]
pub(crate) struct TeleopOptions {
    /// Initial linear speed [m/s]
    #[arg(long, value_name = "SPEED")]
    speed: Option<String>,
    /// Initial angular speed [rad/s]
    #[arg(long, value_name = "SPEED")]
    turn: Option<String>,
    /// Maximum linear speed [m/s]
    #[arg(long, value_name = "SPEED")]
    speed_limit: Option<String>,
    /// Maximum angular speed [rad/s]
    #[arg(long, value_name = "SPEED")]
    turn_limit: Option<String>,
    /// Publish stamped velocities (TwistStamped), as Nav2 and controllers expect
    #[arg(long)]
    stamped: bool,
    /// Frame of stamped velocities
    #[arg(long, value_name = "FRAME")]
    frame_id: Option<String>,
    /// Rate at which the velocity is repeated [Hz] [default: once per key press]
    #[arg(long, value_name = "RATE")]
    repeat_rate: Option<String>,
    /// Time without a key after which the robot stops [s]
    #[arg(long, value_name = "SECONDS")]
    key_timeout: Option<String>,
    /// Remap a topic or the node: `from:=to`
    #[arg(long = "remap", short = 'r', value_name = "FROM:=TO")]
    remaps: Vec<String>,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

pub(crate) fn run(options: &TeleopOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let remaps = options.remaps.iter().flat_map(|rule| ["-r".to_owned(), rule.clone()]);
    let arguments = arguments::read(remaps.chain(ros).collect())?;
    if !io::stdin().is_terminal() {
        return Err(CliError::usage(
            "teleop reads keys from a terminal, and its input is not a terminal; run it in a \
             separate terminal, not from a launch file or a pipe",
        ));
    }
    let live = options.network.open(arguments)?;
    let mut driving = Driving::new(&live.graph, options)?;
    let terminal = RawTerminal::open()?;
    let outcome = driving.go(&live.graph, &terminal);
    drop(terminal);
    // The robot is stopped in every case.
    driving.keyboard.stop();
    driving.publish();
    live.end(FLUSH_TIMEOUT);
    outcome?;
    Ok(ExitCode::SUCCESS)
}

/// Teleop node.
struct Driving {
    keyboard: Keyboard,
    settings: TeleopParams,
    outlet: Outlet,
    clock: Mailbox<Clock>,
    /// Simulated time, if `/clock` is published.
    simulated: Option<Time>,
    _node: Node,
}

enum Outlet {
    Plain(Publisher<Twist>),
    Stamped(Publisher<TwistStamped>),
}

impl Driving {
    /// Creates the node and prints the findings.
    fn new(graph: &Graph, options: &TeleopOptions) -> Result<Self, CliError> {
        let mut found = Diagnostics::new();
        let values = TELEOP.check(options.given(), None, &mut found);
        let made = Self::on(graph, values);
        for finding in graph.take_findings().iter().chain(graph.unused_arguments().iter()) {
            found.push(finding.clone());
        }
        diagnostics(&mut anstream::stderr().lock(), &found, &SourceMap::new())?;
        let driving = made.map_err(CliError::failed)?;
        if found.has_errors() { Err(CliError::Reported(1)) } else { Ok(driving) }
    }

    fn on(graph: &Graph, values: periplus_params::ParamValues) -> Result<Self, GraphError> {
        let node = graph.node(NodeSettings::new("teleop_twist_keyboard"))?;
        let settings = TeleopParams::from_values(&node.parameters(values)?.values());
        let qos = Qos::reliable(10);
        let outlet = if settings.is_stamped {
            Outlet::Stamped(node.publisher("cmd_vel", qos)?)
        } else {
            Outlet::Plain(node.publisher("cmd_vel", qos)?)
        };
        let clock = node.mailbox("/clock", Qos::clock())?;
        let keyboard = settings.keyboard();
        Ok(Self { keyboard, settings, outlet, clock, simulated: None, _node: node })
    }

    /// Runs until the user quits.
    fn go(&mut self, graph: &Graph, terminal: &RawTerminal) -> io::Result<()> {
        terminal.write(SCREEN)?;
        terminal.write(&format!("{}\n", status(&self.keyboard)))?;
        let (mut since_key, mut since_sent) = (Stopwatch::start(), Stopwatch::start());
        let mut lines = 0;
        loop {
            let key = terminal.key(POLL_PERIOD.min(self.repeat_period().unwrap_or(POLL_PERIOD)))?;
            graph.advance_to(unix_ns());
            self.simulated =
                self.clock.latest().map(|clock| clock.clock.clone()).or(self.simulated.take());
            match key.map(|key| self.keyboard.press(key)) {
                Some(Pressed::Quit) => return Ok(()),
                Some(pressed) => {
                    since_key = Stopwatch::start();
                    if let Pressed::Speed { at_limit } = pressed {
                        lines += 1;
                        if lines % LINES_PER_SCREEN == 0 {
                            terminal.write(SCREEN)?;
                        }
                        let limit = if at_limit { "\t(at the maximum)" } else { "" };
                        terminal.write(&format!("{}{limit}\n", status(&self.keyboard)))?;
                    }
                }
                None if self.is_silent(since_key.elapsed()) && self.keyboard.stop() => {}
                None if self.is_due(since_sent.elapsed()) => {}
                None => continue,
            }
            self.publish();
            since_sent = Stopwatch::start();
        }
    }

    fn repeat_period(&self) -> Option<Duration> {
        let rate_hz = self.settings.repeat_rate_hz;
        (rate_hz > 0.0).then(|| Duration::from_secs_f64(1.0 / rate_hz))
    }

    fn is_due(&self, since_sent: Duration) -> bool {
        self.repeat_period().is_some_and(|period| period <= since_sent)
    }

    fn is_silent(&self, since_key: Duration) -> bool {
        let timeout_s = self.settings.key_timeout_s;
        timeout_s > 0.0 && timeout_s < since_key.as_secs_f64()
    }

    fn publish(&self) {
        let twist = Twist::from(self.keyboard.velocity());
        match &self.outlet {
            Outlet::Plain(publisher) => publisher.publish(twist),
            Outlet::Stamped(publisher) => {
                let stamp = self.simulated.clone().unwrap_or_else(|| Time::of_ns(unix_ns()));
                let header = Header { stamp, frame_id: self.settings.frame_id.clone() };
                publisher.publish(TwistStamped { header, twist });
            }
        }
    }
}

impl TeleopOptions {
    fn given(&self) -> Vec<Given<'_>> {
        let texts = [
            ("speed", &self.speed),
            ("turn", &self.turn),
            ("speed_limit", &self.speed_limit),
            ("turn_limit", &self.turn_limit),
            ("frame_id", &self.frame_id),
            ("repeat_rate", &self.repeat_rate),
            ("key_timeout", &self.key_timeout),
        ];
        let given = texts
            .into_iter()
            .filter_map(|(name, text)| text.as_ref().map(|text| Given::new(name, text.as_str())));
        given.chain(self.stamped.then(|| Given::new("stamped", "true"))).collect()
    }
}
