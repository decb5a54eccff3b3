// What Rigel's pages use of Observable Plot. Only this goes into bundle/charts.js.
export {plot, dot, gridX, gridY, line, axisX, axisY, text, ruleX} from '@observablehq/plot';
