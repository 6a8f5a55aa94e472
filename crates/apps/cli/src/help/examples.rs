//! Examples of every command, shown at the end of its `--help`. A test parses each of them.

/// A command line and its purpose.
pub(super) type Example = (&'static str, &'static str);

/// Examples by command. Groups such as `topic` show the first example of each of their commands.
#[rustfmt::skip]
pub(super) const EXAMPLES: &[(&str, &[Example])] = &[
    ("action find", &[
        ("periplus action find nav2_msgs/action/NavigateToPose", "All actions of a type"),
    ]),
    ("action info", &[("periplus action info /navigate_to_pose -t", "Servers and clients, with types")]),
    ("action list", &[("periplus action list -t", "All actions with their types")]),
    ("action send_goal", &[
        ("periplus action send_goal /navigate_to_pose nav2_msgs/action/NavigateToPose '{pose: {header: {frame_id: map}}}' -f", "Send a goal and print the feedback"),
    ]),
    ("action type", &[("periplus action type /navigate_to_pose", "Type of an action")]),
    ("bag check", &[("periplus bag check run.mcap", "Decode every message of a recording")]),
    ("bag convert", &[
        ("periplus bag convert run.mcap -o run.bag", "From ROS 2 to ROS 1"),
        ("periplus bag convert a.mcap b.mcap -o both", "Several recordings into one"),
    ]),
    ("bag cut", &[
        ("periplus bag cut run.mcap -o scans.mcap --topics /scan /tf", "Keep some topics"),
    ]),
    ("bag info", &[("periplus bag info run.mcap", "Duration, topics, types and counts")]),
    ("bag play", &[
        ("periplus bag play run.mcap --clock", "Play to ROS 2 with simulated time"),
        ("periplus bag play old.bag --rate 2 --loop", "A recording of ROS 1, twice as fast, repeated"),
    ]),
    ("bag record", &[
        ("periplus bag record -a -o run", "Record all topics of ROS 2"),
        ("periplus bag record /scan /tf /tf_static -o run", "Record these topics"),
    ]),
    ("bag reindex", &[("periplus bag reindex run", "Rewrite metadata.yaml from the files of a folder")]),
    ("bridge", &[
        ("periplus bridge '/lidar@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan'", "Scans from Gazebo to ROS 2"),
        ("periplus bridge --config bridge.yaml", "Bridge the topics of a file"),
        ("periplus bridge ros1", "ROS 1 and ROS 2, in both directions"),
    ]),
    ("calibrate", &[
        ("periplus calibrate drive.mcap --robot robot.urdf.xacro --plot residuals.png", "Wheels, scanner and IMU, beside the robot's file, with the changes of its texts"),
        ("periplus calibrate drive.mcap --robot robot.urdf.xacro --write", "The values written into the robot's texts"),
    ]),
    ("check", &[
        ("periplus check robot.urdf.xacro lidar:=true", "A robot, expanded with an argument"),
        ("periplus check --strict worlds/house.sdf", "A world; warnings fail too"),
    ]),
    ("compare", &[
        ("periplus compare before.mcap after.mcap --picture paths.png", "Scores of two runs, their differences and a picture"),
        ("periplus compare before.tum after.tum --truth truth.tum", "Two estimates of one true trajectory"),
    ]),
    ("completions", &[
        ("periplus completions bash", "Print the script; put it into ~/.local/share/bash-completion/completions/periplus"),
    ]),
    ("conformance", &[("periplus conformance cases", "Run all case files of a folder")]),
    ("convert", &[
        ("periplus convert robot.urdf.xacro --to urdf -o robot.urdf", "Expand xacro"),
        ("periplus convert robot.urdf --to sdf", "URDF to SDF, on standard output"),
    ]),
    ("costmap", &[("periplus costmap nav2_params.yaml", "Both costmaps of the file, for a robot on ROS 2")]),
    ("demo", &[
        ("periplus demo", "A robot in a room, in the browser"),
        ("periplus demo --headless --duration 60 --out demo", "Explore without a page; results in a folder"),
    ]),
    ("doctor", &[
        ("periplus doctor", "Diagnose the running ROS 2 system"),
        ("periplus doctor worlds/house.sdf --robot robot.urdf.xacro", "Simulate for two seconds and examine"),
        ("periplus doctor nav2_params.yaml", "Examine a parameter file"),
        ("periplus doctor --self", "Check this program and this machine"),
    ]),
    ("doctor costmap", &[("periplus doctor costmap nav2_params.yaml", "Examine the costmaps of a file")]),
    ("interface list", &[("periplus interface list -m", "All messages")]),
    ("interface package", &[("periplus interface package sensor_msgs", "The types of a package")]),
    ("interface packages", &[("periplus interface packages", "All packages with types")]),
    ("interface proto", &[("periplus interface proto geometry_msgs/msg/Twist", "A message to edit and publish")]),
    ("interface show", &[("periplus interface show sensor_msgs/msg/LaserScan", "Fields, constants and comments")]),
    ("launch", &[
        ("periplus launch sam_bot display.launch.py", "A launch file of a package"),
        ("periplus launch robot.launch.xml use_sim_time:=true", "A launch file by its path, with an argument"),
        ("periplus launch robot.launch.py --show-args", "Its arguments; nothing is started"),
        ("periplus launch robot.launch.py --dry-run", "What each of its nodes becomes; nothing is started"),
        ("periplus launch robot.launch.py --duration 10 --record run.mcap", "Ten simulated seconds, recorded"),
    ]),
    ("lifecycle get", &[("periplus lifecycle get /map_server", "State of a node")]),
    ("lifecycle list", &[("periplus lifecycle list /map_server", "Transitions that are possible now")]),
    ("lifecycle nodes", &[("periplus lifecycle nodes", "All managed nodes")]),
    ("lifecycle set", &[("periplus lifecycle set /map_server activate", "Activate a node")]),
    ("localize", &[
        ("periplus localize drive.mcap --map room.yaml --out result", "Localize a recorded drive on a map"),
        ("periplus localize --live --map room.yaml", "The node amcl for a robot on ROS 2"),
    ]),
    ("look", &[
        ("periplus look robot.urdf.xacro -o robot.png", "A robot, from the front left corner"),
        ("periplus look house.sdf --view top -o house.png", "A world from above"),
        ("periplus look house.sdf --robot robot.urdf --topic /scan --time 1 -o scan.png", "A scan of the robot's lidar"),
    ]),
    ("dataset", &[
        ("periplus dataset street.sdf --robot robot.urdf --duration 10 --format coco -o set", "Images with boxes and masks"),
        ("periplus dataset street.sdf --robot robot.urdf --cmd drive.yaml --duration 60 --rate 10 --format lidar -o set", "A drive by a script, with a label for each lidar point"),
        ("periplus dataset street.sdf --robot robot.urdf --duration 10 --format kitti --class 1=Car -o set", "In the layout of KITTI, with a name for label 1"),
    ]),
    ("man", &[
        ("periplus man ~/.local/share/man/man1", "A manual page for every command"),
    ]),
    ("map convert", &[("periplus map convert room.yaml -o room2 --mode scale", "The same map in another mode")]),
    ("map diff", &[("periplus map diff before.yaml after.yaml --picture diff.png", "Align two maps and compare them")]),
    ("map draw", &[("periplus map draw worlds/warehouse.sdf --start=-10,-2.5 -f warehouse", "The map of a world as warehouse.yaml and warehouse.pgm")]),
    ("map info", &[("periplus map info room.yaml", "Size, origin, and fractions of free, occupied and unknown cells")]),
    ("map save", &[("periplus map save -f room", "Save /map as room.yaml and room.pgm")]),
    ("map serve", &[("periplus map serve room.yaml", "Publish /map and offer its services")]),
    ("schema", &[
        ("periplus schema", "Commands that have a schema"),
        ("periplus schema map diff", "Schema of `periplus map diff --json`"),
    ]),
    ("mcp", &[
        ("periplus mcp", "For the configuration of an agent: command `periplus`, argument `mcp`"),
        ("periplus mcp --folder project --tools check,look,sim,slam", "Some tools, on the files of a folder"),
    ]),
    ("navigate", &[
        ("periplus navigate worlds/house.sdf --robot robot.urdf.xacro --pose 0,0,0 --goal 3,0,1.57 --slam-out map", "Drive to a goal while SLAM builds a map, save it"),
        ("periplus navigate worlds/house.sdf --robot robot.urdf.xacro --map map/map.yaml --goal 3,0 --goal 0,0", "Drive to two goals on a map"),
        ("periplus navigate worlds/house.sdf --robot robot.urdf.xacro --goal 3,0 --page", "Watch it on a page in the browser"),
        ("periplus navigate worlds/warehouse.sdf --robot robot.urdf.xacro --pose=-10,-2.5,0 --map warehouse.yaml --robots 20 --random-goals 3", "Twenty robots, each with its own goals"),
    ]),
    ("new package", &[
        ("periplus new package my_bot", "A package with robot, room, launch file and parameters"),
        ("periplus new package my_bot --sim classic", "The same for Gazebo Classic 11"),
    ]),
    ("new robot", &[
        ("periplus new robot my_bot", "Write my_bot.urdf.xacro"),
        ("periplus new robot my_bot --without camera", "A robot without a camera"),
    ]),
    ("new world", &[("periplus new world office", "Write office.sdf")]),
    ("node info", &[("periplus node info /amcl", "Topics, services and actions of a node")]),
    ("node list", &[("periplus node list", "All nodes")]),
    ("param delete", &[("periplus param delete /amcl my_parameter", "Remove a parameter")]),
    ("param describe", &[("periplus param describe /amcl max_particles", "Purpose, type and range")]),
    ("param dump", &[("periplus param dump /amcl", "All parameters as YAML")]),
    ("param get", &[("periplus param get /amcl max_particles", "Value of a parameter")]),
    ("param list", &[("periplus param list /amcl", "Parameters of a node")]),
    ("param load", &[("periplus param load /amcl amcl.yaml", "Set the parameters of a file")]),
    ("param set", &[("periplus param set /amcl max_particles 1000", "Set a parameter")]),
    ("report", &[
        ("periplus report run.mcap", "Write run.html: scores, map, plots, log, parameters"),
        ("periplus report before.mcap after.mcap -o difference.html", "Two runs and their difference"),
    ]),
    ("rerun", &[
        ("periplus rerun slam drive.mcap -p resolution:=0.1 -o coarse.mcap", "The map of a recorded drive with cells of 0.1 m"),
        ("periplus rerun amcl drive.mcap -p map_file:=room.yaml", "Localization of a recorded drive"),
        ("periplus rerun costmap --list", "Parameters of both costmaps"),
    ]),
    ("ros1 call", &[("periplus ros1 call /gazebo/pause_physics", "A service; its type comes from its server")]),
    ("ros1 master", &[("periplus ros1 master", "A master for programs of ROS 1 on this machine")]),
    ("ros1 node cleanup", &[("periplus ros1 node cleanup --yes", "Forget nodes that ended without a word")]),
    ("ros1 node kill", &[("periplus ros1 node kill /listener", "Ask a node to end")]),
    ("ros1 node machine", &[("periplus ros1 node machine", "The machines with nodes")]),
    ("ros1 node ping", &[("periplus ros1 node ping --all", "Call all nodes once")]),
    ("ros1 param delete", &[("periplus ros1 param delete /slam_gmapping", "All parameters of a node")]),
    ("ros1 param dump", &[("periplus ros1 param dump params.yaml", "All parameters in a file")]),
    ("ros1 param get", &[("periplus ros1 param get /use_sim_time", "One parameter")]),
    ("ros1 param list", &[("periplus ros1 param list /slam_gmapping", "The parameters of a node")]),
    ("ros1 param load", &[("periplus ros1 param load params.yaml /robot", "Parameters of a file in a namespace")]),
    ("ros1 param set", &[("periplus ros1 param set /slam_gmapping/delta 0.05", "One parameter")]),
    ("run", &[
        ("periplus run wall_follower.py --ros-args -p speed:=0.3", "A node of a file, with a parameter"),
        ("periplus run my_package wall_follower", "A node of a package in this workspace, without a build"),
        ("periplus run nav2_costmap_2d nav2_costmap_2d_markers", "A built-in program of a package"),
    ]),
    ("scenario", &[
        ("periplus scenario delivery.yaml", "Run a scenario and evaluate its assertions"),
        ("periplus scenario *.yaml --junit results.xml --artifacts results", "All of a folder, with results for a build server"),
        ("periplus scenario delivery.yaml --seed 7 --set speed=0.3 --keep", "With another seed and variable; keep recording and picture"),
        ("periplus scenario --schema", "Schema of the files, for completion in an editor"),
    ]),
    ("score", &[
        ("periplus score run.mcap --map true_map.yaml --picture run.png", "A recording with its truth, on the true map"),
        ("periplus score estimate.tum --truth truth.tum --align se3 --json", "A trajectory, as evo_ape --align"),
    ]),
    ("service call", &[
        ("periplus service call /reset_simulation std_srvs/srv/Empty", "A call without values"),
        ("periplus service call /set_pen std_srvs/srv/SetBool '{data: true}'", "A call with values, as YAML"),
    ]),
    ("service echo", &[("periplus service echo /set_pen", "Requests and responses of a service")]),
    ("service find", &[("periplus service find std_srvs/srv/Empty", "All services of a type")]),
    ("service info", &[("periplus service info /set_pen", "Number of servers and clients")]),
    ("service list", &[("periplus service list -t", "All services with their types")]),
    ("service type", &[("periplus service type /set_pen", "Type of a service")]),
    ("sim", &[
        ("periplus sim worlds/house.sdf --robot robot.urdf.xacro --page", "A robot in a house, on a page in the browser"),
        ("periplus sim worlds/house.sdf --robot robot.urdf.xacro lidar:=true --pose 1,2,0", "With an argument of its xacro, at a pose"),
        ("periplus sim worlds/house.sdf --duration 60 --record run.mcap", "A minute at full speed, recorded"),
        ("periplus sim worlds/house.sdf --robot robot.urdf.xacro --cmd drive.yaml --slam --slam-out map", "Drive by a script, build a map, save it"),
        ("periplus sim worlds/house.sdf --robot robot.urdf.xacro --navigation --page", "Send the robot to goals on the page"),
        ("periplus sim worlds/warehouse.sdf --robot robot.urdf.xacro --robots 100 --dynamics kinematic", "A hundred robots"),
        ("periplus sim worlds/house.sdf --robot robot.urdf.xacro --people 20", "A robot among twenty people"),
    ]),
    ("slam", &[
        ("periplus slam drive.mcap --out map", "A map of a recorded drive"),
        ("periplus slam drive.clf --out map --method gmapping", "Particle filter, from a CARMEN log"),
        ("periplus slam --live", "Map what is on ROS 2 now"),
    ]),
    ("sweep", &[
        ("periplus sweep office.scenario.yaml --param inflation_radius=0.3:0.8:6 --seeds 20", "A parameter of both costmaps, 120 runs"),
        ("periplus sweep office.scenario.yaml --param loss=0,0.2 --param max_speed=0.2:0.6:3 --ray auto", "A grid of two parameters, on a Ray cluster"),
        ("periplus sweep office.scenario.yaml --param inflation_radius=0.3:0.8 --search goal_time_s --trials 30", "Search for the shortest time with Optuna"),
    ]),
    ("teleop", &[("periplus teleop", "Drive with the keys u i o j k l"),
        ("periplus teleop -r cmd_vel:=/robot1/cmd_vel", "A robot with another topic")]),
    ("tf echo", &[("periplus tf echo map base_link", "Pose of base_link in map")]),
    ("tf monitor", &[("periplus tf monitor", "Rates and delays of all frames")]),
    ("tf static", &[
        ("periplus tf static --x 1 --frame-id map --child-frame-id table", "Publish a static transform"),
    ]),
    ("tf tree", &[
        ("periplus tf tree", "Tree of frames of the running system, as .gv and .pdf"),
        ("periplus tf tree run.mcap --svg", "Of a recording, as SVG too"),
    ]),
    ("topic bw", &[("periplus topic bw /points", "Bytes per second")]),
    ("topic delay", &[("periplus topic delay /scan", "Age of the stamps on arrival")]),
    ("topic echo", &[
        ("periplus topic echo /scan --once", "One message"),
        ("periplus topic echo /odom --field pose.pose.position", "One field of each message"),
    ]),
    ("topic find", &[("periplus topic find sensor_msgs/msg/LaserScan", "All topics of a type")]),
    ("topic hz", &[("periplus topic hz /scan /odom", "Messages per second")]),
    ("topic info", &[("periplus topic info /scan -v", "Publishers, subscribers and QoS")]),
    ("topic list", &[("periplus topic list -t", "All topics with their types"),
        ("periplus topic list --gz", "Topics of Gazebo Transport")]),
    ("topic pub", &[
        ("periplus topic pub /cmd_vel geometry_msgs/msg/Twist '{linear: {x: 0.5}}' -r 10", "Ten messages per second"),
        ("periplus topic pub --once /talk std_msgs/msg/String '{data: hello}'", "One message"),
    ]),
    ("topic type", &[("periplus topic type /scan", "Type of a topic")]),
    (
        "view",
        &[
            ("periplus view", "Any ROS 2 system on a page in the browser"),
            ("periplus view run.mcap", "A recording with a timeline"),
        ],
    ),
];
