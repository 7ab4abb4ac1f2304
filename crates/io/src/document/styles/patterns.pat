; Hatches by material, in the distance from line to line. Directions are those of the first of parts that touch.
; Metals as drawing offices in America have them (ASME Y14.2M, ANSI 31 to 38), where these are known; ISO 128-3 has lines at 45 degrees for
; all of them, which is `general`.

*iron, cast and malleable iron: lines
45, 0,0, 0,1

*steel, pairs of lines
45, 0,0, 0,3
45, 0,1.41421356, 0,3

*copper, lines and dashed lines by turns
45, 0,0, 0,2
45, 0,1.41421356, 0,2, 3,-1.2

*brass, lines and dashed lines by turns
45, 0,0, 0,2
45, 0,1.41421356, 0,2, 2,-1

*aluminium, lines, and dashed lines across
45, 0,0, 0,1.6
135, 0,0, 0,3.2, 3,-2

*plastic, lines and lines across
45, 0,0, 0,1.6
135, 0,0, 0,1.6

*rubber, four lines of six
45, 0,0, 0,6
45, 0,1.41421356, 0,6
45, 0,2.82842712, 0,6
45, 0,4.24264069, 0,6

*glass, groups of three short strokes
45, 0,0, 4,4, 3,-5
45, 0,1.13137085, 4,4, 2.2,-5.8
45, 0,-1.13137085, 4,4, 2.2,-5.8

*insulation, a net
45, 0,0, 0,2.2
135, 0,0, 0,2.2

*wood, grain
0, 0,0, 0,7
0, 0,0.7, 0,7, 18,-2
0, 0,1.9, 0,7
0, 0,3.6, 1,7, 25,-3
0, 0,4.3, 0,7
0, 0,5.9, 0,7, 11,-1.5

*concrete, dots and chips
0, 0,0, 2.3,3.1, 0,-4.7
17, 1.3,0.9, 3.1,4.3, 0,-6.1
50, 0.4,2.1, 2.7,5.3, 0.9,-8.3
117, 2.2,0.5, 3.7,6.1, 0.8,-9.1
-20, 3.1,1.7, 4.1,5.9, 0.7,-8.7

*earth, groups of three strokes, turned
0, 0,0, 3,3, 3,-3
0, 0,1, 3,3, 3,-3
0, 0,2, 3,3, 3,-3
90, 3.5,-0.5, 3,3, 3,-3
90, 4.5,-0.5, 3,3, 3,-3
90, 5.5,-0.5, 3,3, 3,-3

*liquid, short level strokes that thin out
0, 0,0, 3,4, 9,-3
0, 1,1, 3,4, 6,-6
0, 2,2, 3,4, 3.5,-8.5
0, 3,3, 3,4, 1.5,-10.5
