//! Composition of sessions.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use periplus_bags::Compression;
use periplus_nav_nodes::slam_toolbox::Pace;
use periplus_os::Stopwatch;
use periplus_sim::{
    AssetFiles, Composition, Driver, Options, PeopleFile, Search, Services, Simulation,
    SimulationRecorder, TopicFilter, compute_topics,
};

use crate::description::describe;
use crate::error::RunError;
use crate::network::{
    GazeboConnection, GazeboSettings, Ros1Connection, Ros1Reach, Ros1Value, Ros2Connection,
    Ros2Reach,
};
use crate::nodes::{EstimatorRequest, Estimators, OpenRmfFleet, OpenRmfMember, RobotProfile};
use crate::page::{Page, PageContext, PageSettings};
use crate::session::{SessionParts, SimulationSession};
use crate::terminal;

/// Recording of a session.
pub struct RecordingRequest {
    /// File, or folder in the format of `ros2 bag`.
    pub path: PathBuf,
    /// Topics to record.
    pub wanted: TopicFilter,
    /// Compression of the messages.
    pub compression: Compression,
}

impl RecordingRequest {
    /// Recording with the default compression.
    #[must_use]
    pub fn new(
        path: impl Into<PathBuf>,
        wanted: impl Fn(&str) -> bool + Send + Sync + 'static,
    ) -> Self {
        Self { path: path.into(), wanted: Box::new(wanted), compression: Compression::default() }
    }

    /// Starts to record a simulation.
    pub(crate) fn start(
        self,
        simulation: &Simulation,
        description: BTreeMap<String, String>,
    ) -> Result<SimulationRecorder, RunError> {
        let Self { path, wanted, compression } = self;
        SimulationRecorder::start_with(simulation, &path, compression, wanted, description)
            .map_err(|error| RunError::Recording { path, error })
    }
}

/// Parts of a session. Everything but the world is optional.
pub struct SessionBuilder {
    composition: Composition,
    options: Options,
    start: Stopwatch,
    is_quiet: bool,
    has_progress: bool,
    factor: Option<f64>,
    search: Search,
    recording: Option<RecordingRequest>,
    records_truth: bool,
    command: Option<String>,
    computed: Option<TopicFilter>,
    driver: Driver,
    people: Option<PeopleFile>,
    open_rmf: Option<String>,
    estimators: Option<EstimatorRequest>,
    ros2: Option<Option<Ros2Reach>>,
    ros1: Option<Ros1Reach>,
    ros1_parameters: Vec<(String, Ros1Value)>,
    gazebo: Option<GazeboSettings>,
    page: Option<PageSettings>,
}

impl SessionBuilder {
    /// Session of a world, at full speed. `start` is the start of the program.
    #[must_use]
    pub fn new(composition: Composition, options: Options, start: Stopwatch) -> Self {
        Self {
            composition,
            options,
            start,
            is_quiet: false,
            has_progress: false,
            factor: None,
            search: Search::default(),
            recording: None,
            records_truth: false,
            command: None,
            computed: None,
            driver: Driver::default(),
            people: None,
            open_rmf: None,
            estimators: None,
            ros2: None,
            ros1: None,
            ros1_parameters: Vec::new(),
            gazebo: None,
            page: None,
        }
    }

    /// Prints only errors.
    #[must_use]
    pub fn quiet(mut self, is_quiet: bool) -> Self {
        self.is_quiet = is_quiet;
        self
    }

    /// Shows a progress bar.
    #[must_use]
    pub fn progress(mut self, has_progress: bool) -> Self {
        self.has_progress = has_progress;
        self
    }

    /// Runs at this real-time factor; `None` is full speed.
    #[must_use]
    pub fn factor(mut self, factor: Option<f64>) -> Self {
        self.factor = factor;
        self
    }

    /// Search paths of entities that clients spawn.
    #[must_use]
    pub fn search(mut self, search: Search) -> Self {
        self.search = search;
        self
    }

    /// Records topics.
    #[must_use]
    pub fn recording(mut self, recording: Option<RecordingRequest>) -> Self {
        self.recording = recording;
        self
    }

    /// Records the true poses of all models, too.
    #[must_use]
    pub fn recording_truth(mut self, records_truth: bool) -> Self {
        self.records_truth = records_truth;
        self
    }

    /// Command that runs this session, for its recordings: without options that do not change the result.
    #[must_use]
    pub fn command(mut self, command: Option<String>) -> Self {
        self.command = command;
        self
    }

    /// Simulates the sensors of these topics even without subscribers.
    #[must_use]
    pub fn computed(mut self, topics: Option<TopicFilter>) -> Self {
        self.computed = topics;
        self
    }

    /// Plays velocity commands.
    #[must_use]
    pub fn driver(mut self, driver: Driver) -> Self {
        self.driver = driver;
        self
    }

    /// Adds people.
    #[must_use]
    pub fn people(mut self, people: Option<PeopleFile>) -> Self {
        self.people = people;
        self
    }

    /// Attaches the robots to Open-RMF as a fleet of this name.
    #[must_use]
    pub fn open_rmf(mut self, fleet: Option<String>) -> Self {
        self.open_rmf = fleet;
        self
    }

    /// Runs estimator nodes. They are the last nodes of the session: names and parameters of
    /// `--ros-args` that no node uses are printed.
    #[must_use]
    pub fn estimators(mut self, request: EstimatorRequest) -> Self {
        self.estimators = Some(request);
        self
    }

    /// Connects to ROS 2. With `None` a real-time session joins on this machine, or as the
    /// environment sets, and continues without ROS 2 if that fails.
    #[must_use]
    pub fn ros2(mut self, reach: Option<Ros2Reach>) -> Self {
        self.ros2 = Some(reach);
        self
    }

    /// Connects to ROS 1: joins the master that `ROS_MASTER_URI` names, or starts one.
    #[must_use]
    pub fn ros1(mut self, reach: Option<Ros1Reach>) -> Self {
        self.ros1 = reach;
        self
    }

    /// Sets parameters of the ROS 1 parameter server, by full names, before anything else does.
    #[must_use]
    pub fn ros1_parameters(mut self, parameters: Vec<(String, Ros1Value)>) -> Self {
        self.ros1_parameters = parameters;
        self
    }

    /// Connects to Gazebo Transport.
    #[must_use]
    pub fn gazebo(mut self, settings: Option<GazeboSettings>) -> Self {
        self.gazebo = settings;
        self
    }

    /// Serves the page.
    #[must_use]
    pub fn page(mut self, settings: Option<PageSettings>) -> Self {
        self.page = settings;
        self
    }

    /// Creates all parts, prints the findings of the files, and connects to the networks.
    ///
    /// # Errors
    /// When a part cannot start.
    pub fn build(mut self) -> Result<SimulationSession, RunError> {
        let files = Arc::new(AssetFiles::default());
        let options = std::mem::take(&mut self.options);
        let description = describe(&self.composition, &options, self.command.as_deref());
        let mut simulation = Simulation::new(&mut self.composition, files, options);
        let is_whole = self.print_file_findings()?;
        if let Some(missing) = self.composition.missing() {
            return Err(RunError::Empty(missing.to_owned()));
        }
        self.add_people(&mut simulation)?;
        let request = self.estimators.take();
        let profiles = request.as_ref().map(|it| it.detect(&mut simulation, self.is_quiet));
        let mut profiles = profiles.transpose()?.unwrap_or_default();
        let recorder = self
            .recording
            .take()
            .map(|request| record(&simulation, request, self.records_truth, description.clone()));
        let recorder = recorder.transpose()?;
        if let Some(page) = &mut self.page {
            page.context_mut().description.clone_from(&description);
        }
        if let Some(topics) = self.computed.take() {
            compute_topics(&simulation, topics);
        }
        let mut services = Services::new(&simulation, std::mem::take(&mut self.search))
            .map_err(RunError::Services)?;
        let warnings = self.driver.join(&simulation).map_err(RunError::Script)?;
        terminal::print_findings(&warnings)?;
        let estimators = self.start_estimators(&simulation, request, &mut profiles)?;
        let fleet = self.start_fleet(&simulation, &profiles, &estimators)?;
        let ros2 = self.connect_ros2(&simulation)?;
        let ros1 = self.connect_ros1(&simulation)?;
        let gazebo = self.connect_gazebo(&simulation, &mut services)?;
        let page = self.open_page(&simulation, &mut services)?;
        Ok(SimulationSession::new(SessionParts {
            page,
            gazebo,
            ros1,
            ros2,
            estimators,
            _fleet: fleet,
            profiles,
            services,
            recorder,
            description,
            driver: self.driver,
            simulation,
            start: self.start,
            factor: self.factor,
            is_quiet: self.is_quiet,
            has_progress: self.has_progress,
            is_whole,
        }))
    }

    /// Adds people, and prints the findings of their file.
    fn add_people(&mut self, simulation: &mut Simulation) -> Result<(), RunError> {
        let Some(people) = self.people.take() else { return Ok(()) };
        let findings = simulation.add_people(&people.request);
        terminal::diagnostics(&mut terminal::messages(), &findings, &people.sources)?;
        if findings.has_errors() { Err(RunError::Reported) } else { Ok(()) }
    }

    /// Prints the findings of the files. Returns false when a requested part is missing.
    fn print_file_findings(&self) -> Result<bool, RunError> {
        let mut err = terminal::messages();
        let mut is_whole = true;
        for loaded in &self.composition.files {
            is_whole &= !loaded.diagnostics.has_errors();
            if !self.is_quiet || loaded.diagnostics.has_errors() {
                terminal::findings(&mut err, loaded)?;
            }
        }
        Ok(is_whole)
    }

    fn start_estimators(
        &self,
        simulation: &Simulation,
        request: Option<EstimatorRequest>,
        profiles: &mut [RobotProfile],
    ) -> Result<Vec<Estimators>, RunError> {
        let Some(request) = request else { return Ok(vec![Estimators::default()]) };
        let pace = if self.factor.is_some() { Pace::Sliced } else { Pace::Whole };
        let estimators = request.start(simulation, profiles, pace)?;
        if !self.is_quiet {
            terminal::print_findings(&simulation.graph().unused_arguments())?;
        }
        Ok(estimators)
    }

    /// Attaches the robots to Open-RMF; their names are those of their namespaces, or of the model of a single robot.
    fn start_fleet(
        &self,
        simulation: &Simulation,
        profiles: &[RobotProfile],
        estimators: &[Estimators],
    ) -> Result<Option<OpenRmfFleet>, RunError> {
        let Some(fleet) = &self.open_rmf else { return Ok(None) };
        let members = profiles.iter().zip(estimators).map(|(profile, estimators)| {
            let only = || simulation.robot_name().unwrap_or("robot");
            let namespace = Some(profile.namespace.name()).filter(|name| !name.is_empty());
            let name = namespace.unwrap_or_else(only).to_owned();
            OpenRmfMember { name, profile, estimators }
        });
        let started = OpenRmfFleet::start(simulation.graph(), fleet, members);
        started.map(Some).map_err(|error| RunError::node("the fleet", error))
    }

    fn connect_gazebo(
        &mut self,
        simulation: &Simulation,
        services: &mut Services,
    ) -> Result<Option<GazeboConnection>, RunError> {
        let settings = self.gazebo.take();
        let joined = settings
            .map(|settings| GazeboConnection::join(simulation, services, settings, self.is_quiet));
        joined.transpose()
    }

    fn connect_ros1(
        &mut self,
        simulation: &Simulation,
    ) -> Result<Option<Ros1Connection>, RunError> {
        let parameters = std::mem::take(&mut self.ros1_parameters);
        let join =
            |reach| Ros1Connection::join(simulation.graph(), reach, parameters, self.is_quiet);
        self.ros1.map(join).transpose()
    }

    fn connect_ros2(&self, simulation: &Simulation) -> Result<Ros2Connection, RunError> {
        match self.ros2 {
            None => Ok(Ros2Connection::default()),
            Some(reach) => {
                Ros2Connection::join(simulation, reach, self.factor.is_some(), self.is_quiet)
            }
        }
    }

    fn open_page(
        &self,
        simulation: &Simulation,
        services: &mut Services,
    ) -> Result<Option<Page>, RunError> {
        let Some(settings) = &self.page else { return Ok(None) };
        show(services, simulation, settings.context())?;
        Ok(Page::open(simulation.graph(), settings)?)
    }
}

fn record(
    simulation: &Simulation,
    request: RecordingRequest,
    records_truth: bool,
    description: BTreeMap<String, String>,
) -> Result<SimulationRecorder, RunError> {
    let recorder = request.start(simulation, description)?;
    if records_truth {
        recorder.with_truth(simulation).map_err(RunError::Services)
    } else {
        Ok(recorder)
    }
}

/// Starts what a page shows of a simulation: its models, and the file to which it may write the world.
pub(crate) fn show(
    services: &mut Services,
    simulation: &Simulation,
    context: &PageContext,
) -> Result<(), RunError> {
    services.show(simulation, context.folders()).map_err(RunError::Display)?;
    if let Some(file) = &context.world_out {
        services.write_world_to(simulation, file.clone()).map_err(RunError::Display)?;
    }
    Ok(())
}
