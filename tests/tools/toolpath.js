// Prints what gcode-toolpath (cncjs) makes of G-code programs: a line for each move, a blank one behind each program.
//
//   NODE_PATH=DIR/node_modules node tests/tools/toolpath.js FILE...
//
// G0 and G1: `0 x y z` and `1 x y z`; arcs: `2 x y z i j`, with the centre, absolute. Lengths are millimetres.
const { readFileSync } = require('fs');
const Toolpath = require('gcode-toolpath');

for (const file of process.argv.slice(2)) {
  const moves = [];
  const number = (text) => text.replace(/^G/, '');
  const toolpath = new Toolpath({
    addLine: (modal, from, to) => moves.push([number(modal.motion), to.x, to.y, to.z]),
    addArcCurve: (modal, from, to, centre) => moves.push([number(modal.motion), to.x, to.y, to.z, centre.x, centre.y]),
  });
  toolpath.loadFromStringSync(readFileSync(file, 'utf8'));
  console.log(moves.map((move) => move.join(' ')).join('\n') + '\n');
}
