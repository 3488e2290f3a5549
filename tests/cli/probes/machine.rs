//! Simulates a machine that moves the tool by the numbers in a program. It shares no code with the writer.

/// A move between two points in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub from: [f64; 3],
    pub to: [f64; 3],
    pub way: Way,
    /// Whether the height of the end was corrected.
    pub is_corrected: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Way {
    Rapid,
    Straight,
    /// An arc around a centre; the angle in radians is negative if clockwise.
    Round {
        centre: [f64; 2],
        angle: f64,
    },
}

pub(crate) fn motions(program: &str) -> Vec<Motion> {
    let mut at = [0.0, 0.0, 1000.0];
    let blocks = program.lines().filter(|line| line.starts_with("G0"));
    blocks
        .map(|block| {
            let motion = motion(block, at);
            at = motion.to;
            motion
        })
        .collect()
}

fn motion(block: &str, from: [f64; 3]) -> Motion {
    let (words, is_corrected) = match block.split_once("(==") {
        Some((words, _)) => (words, true),
        None => (block, false),
    };
    let word = |letter: char| {
        let word = words.split(' ').find_map(|word| word.strip_prefix(letter))?;
        Some(word.parse::<f64>().unwrap_or_else(|_| panic!("{block}")))
    };
    let to = ['X', 'Y', 'Z'].into_iter().zip(from).map(|(letter, old)| word(letter).unwrap_or(old));
    let to: [f64; 3] = to.collect::<Vec<_>>().try_into().unwrap();
    let centre = || [from[0] + word('I').unwrap(), from[1] + word('J').unwrap()];
    let way = match words.split(' ').next().unwrap() {
        "G00" => Way::Rapid,
        "G01" => Way::Straight,
        "G02" => Way::Round { centre: centre(), angle: -turned(centre(), to, from) },
        "G03" => Way::Round { centre: centre(), angle: turned(centre(), from, to) },
        other => panic!("{other}"),
    };
    Motion { from, to, way, is_corrected }
}

/// Returns the counterclockwise angle between two points, greater than 0 and at most a full turn.
fn turned(centre: [f64; 2], from: [f64; 3], to: [f64; 3]) -> f64 {
    let angle = |point: [f64; 3]| libm::atan2(point[1] - centre[1], point[0] - centre[0]);
    let turned = (angle(to) - angle(from)).rem_euclid(std::f64::consts::TAU);
    if turned < 1e-9 { std::f64::consts::TAU } else { turned }
}

impl Motion {
    /// Returns the length in the plane in mm.
    pub(crate) fn length(&self) -> f64 {
        match self.way {
            Way::Round { centre, angle } => {
                angle.abs() * libm::hypot(self.from[0] - centre[0], self.from[1] - centre[1])
            }
            _ => libm::hypot(self.to[0] - self.from[0], self.to[1] - self.from[1]),
        }
    }

    /// Returns the position of the tool at a fraction of the motion.
    pub(crate) fn at(&self, part: f64) -> [f64; 3] {
        let between = |axis: usize| self.from[axis] + (self.to[axis] - self.from[axis]) * part;
        let [x, y] = match self.way {
            Way::Round { centre, angle } => {
                let (sin, cos) = libm::sincos(angle * part);
                let (x, y) = (self.from[0] - centre[0], self.from[1] - centre[1]);
                [centre[0] + x * cos - y * sin, centre[1] + x * sin + y * cos]
            }
            _ => [between(0), between(1)],
        };
        [x, y, between(2)]
    }

    pub(crate) fn is_milling(&self) -> bool {
        self.way != Way::Rapid && self.length() > 0.0
    }
}
