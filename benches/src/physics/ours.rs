//! Our side: `robots/sam_bot`, read from its files.

use std::f64::consts::TAU;
use std::path::Path;
use std::time::Instant;

use periplus_loader::{LoadContext, load};
use periplus_os::Machine;
use periplus_physics::{
    JointCommand, JointId, LinkId, ModelId, NoMeshes, PhysicsMode, PhysicsWorld, Twist,
};
use periplus_resources::Resolver;
use periplus_scene::{Collision, DVec3, Link, Model, Pose, Shape};

use super::{Block, Order, Outcome, RADIUS_M, SEPARATION_M};

const STEP_NS: i64 = 1_000_000;
/// Steps timed together; the fastest count.
const CHUNK: u32 = 100;
/// The middle of the body stands this high.
const HEIGHT_M: f64 = 0.15;
/// The motors of the peers have the same [N m].
const TORQUE_N_M: f64 = 20.0;

struct Robot {
    world: PhysicsWorld,
    model: ModelId,
    base: LinkId,
    wheels: [JointId; 2],
}

pub(super) fn drive_all(orders: &[Order]) -> Result<Vec<Outcome>, String> {
    let model = sam_bot()?;
    orders.iter().map(|order| drive(&model, order)).collect()
}

/// One step of the exact mode, with new orders at each step.
pub(super) fn kinematic_us_per_step() -> Result<f64, String> {
    let mut robot = Robot::new(&sam_bot()?, PhysicsMode::Kinematic, Block::Nothing)?;
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        let steps = 2000;
        let start = Instant::now();
        for _ in 0..steps {
            robot.world.follow(robot.model, Twist { x_m_s: 0.5, y_m_s: 0.0, yaw_rad_s: 0.2 });
            robot.turn(0.5, 0.2);
            robot.world.step(STEP_NS).map_err(|why| why.to_string())?;
        }
        best = best.min(start.elapsed().as_secs_f64() / f64::from(steps) * 1e6);
    }
    Ok(best)
}

fn sam_bot() -> Result<Model, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let host = Machine;
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: root.clone(),
        arguments: Vec::new(),
        open_meshes: false,
    };
    let loaded = load(&root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro"), &setting);
    let model = loaded.scene.and_then(|scene| scene.models.into_iter().next());
    model.ok_or_else(|| "robots/sam_bot does not load".into())
}

fn fixed(name: &str, shape: Shape) -> Model {
    let link = Link { collisions: vec![Collision::new(name, shape)], ..Link::new(name) };
    Model { is_static: true, links: vec![link], ..Model::new(name) }
}

impl Robot {
    fn new(model: &Model, mode: PhysicsMode, block: Block) -> Result<Self, String> {
        let mut world = PhysicsWorld::empty(DVec3::new(0.0, 0.0, -9.81), mode);
        let floor = fixed("floor", Shape::Plane { normal: DVec3::Z, size_m: [100.0; 2] });
        let mut put = |model: &Model, pose: Pose| {
            world.add(model, pose, &NoMeshes).model.ok_or(format!("{} is refused", model.name))
        };
        put(&floor, Pose::IDENTITY)?;
        match block {
            Block::Nothing => {}
            Block::Wall => {
                let wall = fixed("wall", Shape::Box { size_m: DVec3::new(0.2, 6.0, 1.0) });
                put(&wall, Pose::from_xyz(2.1, 0.0, 0.5))?;
            }
            Block::Step => {
                let step = fixed("step", Shape::Box { size_m: DVec3::new(2.0, 6.0, 0.01) });
                put(&step, Pose::from_xyz(2.0, 0.0, 0.005))?;
            }
        }
        let model = put(model, Pose::from_xyz(0.0, 0.0, HEIGHT_M))?;
        let joint = |name: &str| world.find_joint(model, name).ok_or(format!("no joint {name}"));
        let wheels = [joint("drivewhl_l_joint")?, joint("drivewhl_r_joint")?];
        let base = world.find_link(model, "base_link").ok_or("no base_link")?;
        Ok(Self { world, model, base, wheels })
    }

    fn turn(&mut self, ahead_m_s: f64, turn_rad_s: f64) {
        for (wheel, side) in self.wheels.into_iter().zip([-1.0, 1.0]) {
            let target = (ahead_m_s + side * turn_rad_s * SEPARATION_M / 2.0) / RADIUS_M;
            self.world.command(wheel, JointCommand::Velocity { target, max_effort: TORQUE_N_M });
        }
    }

    fn pose(&self) -> Pose {
        self.world.link_state(self.base).map_or(Pose::IDENTITY, |state| state.world_from_link)
    }

    fn angles(&self) -> [f64; 2] {
        self.wheels.map(|wheel| self.world.axis_state(wheel).map_or(0.0, |axis| axis.position))
    }
}

fn drive(model: &Model, order: &Order) -> Result<Outcome, String> {
    let mut robot = Robot::new(model, PhysicsMode::Rigid, order.block)?;
    robot.turn(0.0, 0.0);
    for _ in 0..1000 {
        robot.world.step(STEP_NS).map_err(|why| why.to_string())?;
    }
    let (start, before) = (robot.pose(), robot.angles());
    robot.turn(order.ahead_m_s, order.turn_rad_s);
    let (mut turned_rad, mut last_rad, mut best_s) = (0.0, start.rpy().yaw, f64::INFINITY);
    let chunks = (order.time_s * 10.0).round() as usize;
    for _ in 0..chunks {
        let began = Instant::now();
        for _ in 0..CHUNK {
            robot.world.step(STEP_NS).map_err(|why| why.to_string())?;
        }
        best_s = best_s.min(began.elapsed().as_secs_f64());
        let now_rad = robot.pose().rpy().yaw;
        turned_rad += (now_rad - last_rad + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
        last_rad = now_rad;
    }
    let (end, after) = (robot.pose(), robot.angles());
    let way = start.inverse() * end;
    Ok(Outcome {
        along_m: way.translation.x,
        aside_m: way.translation.y,
        turned_rad,
        wheels_rad: [after[0] - before[0], after[1] - before[1]],
        height_m: end.translation.z,
        us_per_step: best_s / f64::from(CHUNK) * 1e6,
    })
}
