use crate::random::Random;
use pathbuild_draw::model::{Arc, Entity, Point, Shape};

/// Draws a path element by element.
#[derive(Debug)]
pub(super) struct Pen<'a> {
    pub(super) random: &'a mut Random,
    pub(super) at: Point,
    entities: Vec<Entity>,
}

impl<'a> Pen<'a> {
    pub(super) fn new(random: &'a mut Random, start: Point, text: &str) -> Self {
        Self { random, at: start, entities: vec![Entity::start(start).note(text)] }
    }

    pub(super) fn add(&mut self, entity: Entity) {
        self.entities.push(entity);
    }

    /// Draws a line from the current point.
    pub(super) fn line(&mut self, to: Point, line_type: &str, text: &str) {
        // One line in four is drawn from its end, as happens when users copy and mirror.
        let (from, end) = if self.random.once_in(4) { (to, self.at) } else { (self.at, to) };
        self.add(Entity::line(from, end).typed(line_type).note(text));
        self.at = to;
    }

    /// Draws an arc with this bulge from the current point.
    pub(super) fn arc(&mut self, to: Point, bulge: f64, line_type: &str, text: &str) {
        match Arc::bulged(self.at, to, bulge) {
            Some(arc) => self.add(Entity::new(Shape::Arc(arc)).typed(line_type).note(text)),
            None => self.add(Entity::line(self.at, to).typed(line_type).note(text)),
        }
        self.at = to;
    }

    /// Draws a circle around the current point.
    pub(super) fn circle(&mut self, diameter: f64, line_type: &str, text: &str) {
        self.add(Entity::circle(self.at, diameter).typed(line_type).note(text));
    }

    /// Draws a rapid move, sometimes with its own sweep height.
    pub(super) fn sweep(&mut self, to: Point, thickness: f64) {
        if self.random.once_in(6) {
            let height = thickness + self.random.between(1.0, 6.0, 0.5);
            self.line(to, "DASHED", &format!("S{}", super::plan::comma(height)));
        } else {
            self.line(to, "HIDDEN", "");
        }
    }

    /// Draws the end marker and returns the path.
    pub(super) fn end(mut self, at: Point) -> Vec<Entity> {
        self.add(Entity::end(at));
        self.entities
    }
}
