// SPDX-License-Identifier: Apache-2.0
// Where a tool is held for a point on the surface. A tool's frame: tip at the origin, handle
// towards +z, a blade in the plane y = 0.
import { Matrix4, Quaternion, Vector3 } from 'three';

export interface ToolPose {
  p: Vector3;
  q: Quaternion;
}

const bladeTilt = (12 * Math.PI) / 180; // a scalpel's handle leans back
const pushedTilt = (68 * Math.PI) / 180; // a slit knife is held flat

// A frame whose z axis is `z` and whose x axis is as near to `x` as can be.
function frameOf(x: Vector3, z: Vector3): Quaternion {
  const zAxis = z.clone().normalize();
  const xAxis = x.clone().addScaledVector(zAxis, -x.dot(zAxis));
  if (xAxis.lengthSq() < 1e-12) xAxis.set(zAxis.z, zAxis.x, zAxis.y).cross(zAxis);
  xAxis.normalize();
  const yAxis = zAxis.clone().cross(xAxis);
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(xAxis, yAxis, zAxis));
}

// Handle along the outward normal, the tip `depth` below the surface; `radius`: of a ball at the
// tip, whose lowest point then is at that depth.
export function pressPose(
  point: Vector3,
  normal: Vector3,
  depth: number,
  radius: number,
): ToolPose {
  return {
    p: point.clone().addScaledVector(normal, radius - depth),
    q: frameOf(new Vector3(1, 0, 0), normal),
  };
}

// A blade that moves along `direction` and cuts to its +x (`side` 1) or -x (-1).
export function bladePose(
  point: Vector3,
  normal: Vector3,
  direction: Vector3,
  depth: number,
  side: 1 | -1,
): ToolPose {
  const along = tangential(direction, normal);
  const handle = normal.clone().multiplyScalar(Math.cos(bladeTilt));
  handle.addScaledVector(along, -Math.sin(bladeTilt));
  return {
    p: point.clone().addScaledVector(normal, -depth),
    q: frameOf(along.multiplyScalar(side), handle),
  };
}

// A two-sided blade that goes in along its axis, flat to the surface.
export function pushedPose(
  point: Vector3,
  normal: Vector3,
  direction: Vector3,
  depth: number,
): ToolPose {
  const along = tangential(direction, normal);
  const handle = normal.clone().multiplyScalar(Math.cos(pushedTilt));
  handle.addScaledVector(along, -Math.sin(pushedTilt));
  return {
    p: point.clone().addScaledVector(normal, -depth),
    q: frameOf(along.cross(normal), handle),
  };
}

// The same pose drawn back along its handle.
export function lifted(pose: ToolPose, by: number): ToolPose {
  const handle = new Vector3(0, 0, 1).applyQuaternion(pose.q);
  return { p: pose.p.clone().addScaledVector(handle, by), q: pose.q.clone() };
}

export function tangential(direction: Vector3, normal: Vector3): Vector3 {
  const out = direction.clone().addScaledVector(normal, -direction.dot(normal));
  if (out.lengthSq() < 1e-18) out.set(1, 0, 0).addScaledVector(normal, -normal.x);
  return out.normalize();
}
