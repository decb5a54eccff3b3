// What Rigel's pages use of Observable Plot. Only this goes into bundle/charts.js.
export {plot, areaY, axisX, axisY, barX, barY, cell, dot, gridX, gridY, line, rect, ruleX, ruleY, text} from '@observablehq/plot';
