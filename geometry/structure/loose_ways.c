/* Implements the search for directions in which nothing holds a node, by the eigenvectors of its stiffness matrix
 * (Jacobi's rotations). */
#include "geometry/structure/loose_ways.h"

#include <math.h>
#include <string.h>

#define NO_STIFFNESS 1e-12 /* fraction of a node's greatest stiffness below which a stiffness counts as 0, because it
                            * may be a rounding error */

/* Diagonalizes the symmetric matrix a in place, by Jacobi's rotations. The columns of v become its eigenvectors. */
static void jacobi(double a[VS_WAYS][VS_WAYS], double v[VS_WAYS][VS_WAYS]) {
  memset(v, 0, sizeof(vs_node_stiffness));
  for (int i = 0; i < VS_WAYS; i++) v[i][i] = 1;
  for (int sweep = 0; sweep < 40; sweep++) {
    double off = 0;
    for (int p = 0; p < VS_WAYS; p++)
      for (int q = p + 1; q < VS_WAYS; q++) off += a[p][q] * a[p][q];
    if (off < 1e-40) return;
    for (int p = 0; p < VS_WAYS; p++)
      for (int q = p + 1; q < VS_WAYS; q++) {
        if (a[p][q] == 0) continue;
        double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        double t = (theta < 0 ? -1 : 1) / (fabs(theta) + hypot(theta, 1)), c = 1 / hypot(t, 1), s = t * c;
        for (int k = 0; k < VS_WAYS; k++) {
          double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < VS_WAYS; k++) {
          double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
          x = v[k][p], y = v[k][q];
          v[k][p] = c * x - s * y, v[k][q] = s * x + c * y;
        }
      }
  }
}

int vs_loose_ways(vs_node_stiffness b, const bool held[VS_WAYS], double motion[VS_WAYS][VS_WAYS],
                  bool unturned[VS_WAYS]) {
  double a[VS_WAYS][VS_WAYS], v[VS_WAYS][VS_WAYS], most[2] = { 0, 0 }, scale[VS_WAYS];
  int found = 0;
  for (int i = 0; i < VS_WAYS; i++)
    if (b[i][i] > most[i / 3]) most[i / 3] = b[i][i];
  for (int i = 0; i < VS_WAYS; i++) {
    scale[i] = most[i / 3] > 0 ? 1 / sqrt(most[i / 3]) : 1;
    unturned[i] = i >= 3 && !held[i] && most[1] <= 0;
  }
  for (int i = 0; i < VS_WAYS; i++)
    for (int j = 0; j < VS_WAYS; j++) {
      bool still = held[i] || held[j] || unturned[i] || unturned[j];
      a[i][j] = still ? (i == j) : b[i][j] * scale[i] * scale[j];
    }
  jacobi(a, v);
  memset(b, 0, sizeof(vs_node_stiffness));
  for (int k = 0; k < VS_WAYS; k++) {
    if (!(a[k][k] < NO_STIFFNESS)) continue;
    for (int i = 0; i < VS_WAYS; i++) {
      motion[found][i] = v[i][k] * scale[i];
      for (int j = 0; j < VS_WAYS; j++) b[i][j] += v[i][k] / scale[i] * v[j][k] / scale[j];
    }
    found++;
  }
  VS_ASSERT(found <= VS_WAYS);
  return found;
}
