// An example program with a mistake: before the last slot, the cutter travels at cutting depth.

export const EXAMPLE_NAME = "example.nc";

export const EXAMPLE = `%
(a plate with two pockets and a slot)
(TOOL/MILL, 6, 0, 20, 0)
(STOCK/BLOCK, 100, 45, 10, 0, 0, 10)
G90 G94 G17 G21
T1 M6
S12000 M3
G0 Z5
G0 X10 Y10
(Pocket 1)
G0 Z1
G1 Z-2 F200
G1 X40 F800
G1 Y15
G1 X10
G1 Y10
G1 Z-4 F200
G1 X40 F800
G1 Y15
G1 X10
G1 Y10
G0 Z5
(Pocket 2)
G0 X60 Y10
G0 Z1
G1 Z-3 F200
G2 X60 Y10 I10 J0 F800
G0 Z5
(Slot)
G0 X10 Y30
G0 Z1
G1 Z-2 F200
G1 X40 F800
G0 X60
G1 X85 F800
G0 Z5
M5
M30
%
`;
