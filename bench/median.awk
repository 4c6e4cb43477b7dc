# For the programs of other scripts: awk "$(cat bench/median.awk)"'...'
# The median of values[key], numbers with spaces between them.
function median(key,   n, i, j, t, v) {
  n = split(values[key], v, " ")
  for (i = 1; i <= n; i++) for (j = i + 1; j <= n; j++) if (v[j] + 0 < v[i] + 0) { t = v[i]; v[i] = v[j]; v[j] = t }
  return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
}
