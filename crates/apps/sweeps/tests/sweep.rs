//! Sweeps of a short scenario: plan, runs, results, table.
#![allow(clippy::unwrap_used, clippy::panic, clippy::disallowed_methods, reason = "tests")]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use periplus_sweeps::{
    ColumnValues, ParameterTarget, SweepError, SweepFolder, SweepPlan, SweepRequest, SweepTable,
    grid, overview_svg, run_job, statistics, write_parquet,
};

/// The log of file accesses belongs to the process, so that only one test at a time may plan or run.
static ONE: Mutex<()> = Mutex::new(());

/// Folder that is removed at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("periplus-sweep-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path.canonicalize().unwrap())
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).unwrap();
        path
    }

    /// A scenario of two seconds, whose files are copies.
    fn scenario(&self) -> PathBuf {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
        let copy = |from: &str, to: &str| fs::copy(root.join(from), self.0.join(to)).unwrap();
        copy("worlds/demo_room.sdf", "room.sdf");
        self.write("robot.sdf", ROBOT);
        self.write("short.scenario.yaml", SCENARIO)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const ROBOT: &str = r#"<sdf version="1.9"><model name="bot">
  <link name="base_link">
    <inertial><mass>1</mass></inertial>
    <collision name="c"><pose>0 0 0.1 0 0 0</pose><geometry><cylinder><radius>0.15</radius><length>0.1</length></cylinder></geometry></collision>
    <sensor name="lidar" type="gpu_lidar"><topic>/scan</topic><update_rate>5</update_rate><pose>0 0 0.2 0 0 0</pose>
      <lidar><scan><horizontal><samples>60</samples><min_angle>-3.1</min_angle><max_angle>3.1</max_angle></horizontal></scan>
      <range><min>0.1</min><max>10</max></range></lidar></sensor>
  </link>
</model></sdf>"#;

const SCENARIO: &str = "world: room.sdf\nrobot: {file: robot.sdf}\nphysics: kinematic\ntimeout: 2\nseed: 5\n\
    variables: {loss: 0, hz: 5}\nnodes: [slam]\n\
    faults:\n  - dropout: {topic: /scan, probability: $(loss)}\n\
    assertions:\n  - rate: {topic: /scan, hz: $(hz), from: 0}\n  - no_collision\n";

fn request(scenario: &Path, parameters: &[&str], seed_count: usize) -> SweepRequest {
    let ranges: Vec<periplus_sweeps::ParameterRange> =
        parameters.iter().map(|text| text.parse().unwrap()).collect();
    SweepRequest {
        scenario: scenario.to_owned(),
        names: ranges.iter().map(|range| range.name().to_owned()).collect(),
        points: grid(&ranges).unwrap(),
        seed_count,
        ..SweepRequest::default()
    }
}

fn keys(plan: &SweepPlan) -> Vec<String> {
    plan.jobs.iter().map(|job| job.key.clone()).collect()
}

fn usage(result: Result<SweepPlan, SweepError>) -> String {
    match result {
        Err(SweepError::Usage(message)) => message,
        other => panic!("{other:?}"),
    }
}

/// Runs all jobs without results, and returns the table as a file.
fn table(folder: &SweepFolder, plan: &SweepPlan) -> (SweepTable, Vec<u8>) {
    for (index, job) in plan.jobs.iter().enumerate() {
        if !folder.has_result(job) {
            folder.run(plan, index, true).unwrap();
        }
    }
    let results = plan.jobs.iter().map(|job| Ok(folder.result(job).unwrap().unwrap()));
    let table = SweepTable::assemble(plan, &results.collect::<Vec<_>>());
    let file = write_parquet(&table, "test", &[]);
    (table, file)
}

#[test]
fn a_sweep_continues_and_its_table_does_not_depend_on_the_order_of_the_runs() {
    let _one = ONE.lock();
    let place = Folder::new("order");
    let scenario = place.scenario();
    let folder = SweepFolder::at(&place.0.join("a"));
    let request = request(&scenario, &["loss=0,0.9"], 2);
    let plan = SweepPlan::make(&request, &folder).unwrap();
    assert_eq!(plan.jobs.iter().map(|job| job.seed).collect::<Vec<_>>(), [5, 6, 5, 6]);
    let (first, bytes) = table(&folder, &plan);
    assert_eq!(
        first.column("loss").unwrap().values,
        ColumnValues::Double([0.0, 0.0, 0.9, 0.9].map(Some).into())
    );
    let passed = [true, true, false, false].map(Some).to_vec();
    assert_eq!(first.column("passed").unwrap().values, ColumnValues::Bool(passed));
    // 10 scans in 2 s: the last one of the 2 s may or may not count.
    let rate = first.column("assert1_rate_hz").unwrap().values.numbers();
    assert!((4.4..5.6).contains(&rate[0].unwrap()), "{rate:?}");
    let digests = match &first.column("digest").unwrap().values {
        ColumnValues::Text(all) => all.clone(),
        other => panic!("{other:?}"),
    };
    assert_ne!(digests[2], digests[3], "another seed, other losses");
    // Artifacts of the runs that failed, and of no other.
    let has_artifacts: Vec<bool> =
        plan.jobs.iter().map(|job| folder.failure_folder(job).join("run.mcap").exists()).collect();
    assert_eq!(has_artifacts, [false, false, true, true]);
    // The same plan has nothing left to do; one result that is removed comes back as it was.
    assert_eq!(SweepPlan::make(&request, &folder).unwrap(), plan);
    let lost = folder.result_file(&plan.jobs[1]);
    let before = fs::read(&lost).unwrap();
    fs::remove_file(&lost).unwrap();
    assert_eq!(table(&folder, &plan).1, bytes);
    assert_eq!(fs::read(&lost).unwrap(), before);
    // Another folder, the last job first.
    let other = SweepFolder::at(&place.0.join("b"));
    let same = SweepPlan::make(&request, &other).unwrap();
    assert_eq!(keys(&same), keys(&plan));
    for index in (0..4).rev() {
        other.run(&same, index, false).unwrap();
    }
    assert_eq!(table(&other, &same).1, bytes);
    let points = statistics(&plan, &first);
    let share =
        |point: usize| points[point].metrics.iter().find(|it| it.name == "passed").unwrap().mean;
    assert_eq!([points.len(), points[0].runs], [2, 2]);
    assert_eq!([share(0), share(1)], [1.0, 0.0]);
    assert!(overview_svg(&plan, &first).contains("passed (share of runs)"));
}

#[test]
fn a_key_changes_with_files_values_and_seeds_only() {
    let _one = ONE.lock();
    let place = Folder::new("keys");
    let scenario = place.scenario();
    let folder = SweepFolder::at(&place.0.join("a"));
    let plan =
        |parameters: &[&str]| SweepPlan::make(&request(&scenario, parameters, 2), &folder).unwrap();
    let base = plan(&["loss=0,0.5"]);
    let all: std::collections::BTreeSet<String> = keys(&base).into_iter().collect();
    assert_eq!(all.len(), 4);
    // A wider sweep has the same runs, and others.
    assert_eq!(keys(&plan(&["loss=0.5,1"]))[..2], keys(&base)[2..]);
    // Other files in the folder, and other folders, change nothing.
    place.write("other.txt", "x");
    assert_eq!(keys(&plan(&["loss=0,0.5"])), keys(&base));
    let elsewhere = Folder::new("elsewhere");
    let moved = request(&elsewhere.scenario(), &["loss=0,0.5"], 2);
    assert_eq!(keys(&SweepPlan::make(&moved, &folder).unwrap()), keys(&base));
    // The robot is one of its files.
    place.write("robot.sdf", &ROBOT.replace("<samples>60", "<samples>61"));
    let changed = keys(&plan(&["loss=0,0.5"]));
    assert!(changed.iter().all(|key| !all.contains(key)));
}

#[test]
fn names_and_values_are_checked_before_anything_runs() {
    let _one = ONE.lock();
    let place = Folder::new("names");
    let scenario = place.scenario();
    let folder = SweepFolder::at(&place.0.join("a"));
    let make = |parameters: &[&str]| SweepPlan::make(&request(&scenario, parameters, 1), &folder);
    let plan = make(&["minimum_travel_distance=1,2.5"]).unwrap();
    let set = plan.jobs.iter().map(|job| job.parameters[0][2].as_str());
    assert_eq!(set.collect::<Vec<_>>(), ["1", "2.5"]);
    let ParameterTarget::Parameters(all) = &plan.targets[0] else { panic!("{:?}", plan.targets) };
    assert_eq!(all[..], [("/slam_toolbox".to_owned(), "minimum_travel_distance".to_owned())]);
    let message = usage(make(&["minimum_travel_distanc=1"]));
    assert!(message.contains("did you mean `minimum_travel_distance`?"), "{message}");
    let message = usage(make(&["minimum_travel_distance=far"]));
    assert!(message.contains("minimum_travel_distance=far`"), "{message}");
    let bad = make(&["loss=2"]);
    assert!(matches!(bad, Err(SweepError::Findings(_))), "{bad:?}");
}

#[test]
fn a_copy_that_was_changed_is_refused() {
    let _one = ONE.lock();
    let place = Folder::new("copy");
    let scenario = place.scenario();
    let folder = SweepFolder::at(&place.0.join("a"));
    let plan = SweepPlan::make(&request(&scenario, &[], 1), &folder).unwrap();
    let tree = folder.tree(&plan.inputs);
    // Runs do not see later changes of the files themselves.
    place.write("robot.sdf", "no robot");
    assert!(run_job(&plan, 0, &tree, None).is_ok());
    let copy = plan.inputs.files.iter().find(|file| file.path.ends_with("robot.sdf")).unwrap();
    fs::write(tree.join(copy.path.strip_prefix("/").unwrap()), "no robot").unwrap();
    let message = run_job(&plan, 0, &tree, None).unwrap_err().to_string();
    assert!(message.contains("robot.sdf has changed"), "{message}");
}
