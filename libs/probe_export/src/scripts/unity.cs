// Light probes that `ssphh probe export --to unity` wrote. Put this file and the .json beside it into a project's Assets
// folder; docs/engines/unity.md tells the steps.
#if UNITY_EDITOR
using System;
using System.IO;
using UnityEditor;
using UnityEngine;
using UnityEngine.Rendering;

public static class SsphhProbes
{
    [Serializable]
    class ProbeFile
    {
        public string format;
        public int version;
        public float[] positions;  // x, y, z of each probe
        public float[] light;      // 27 of each probe: nine red, nine green, nine blue
    }

    static ProbeFile Read()
    {
        string path = EditorUtility.OpenFilePanel("Light probes of ssphh", Application.dataPath, "json");
        if (string.IsNullOrEmpty(path)) return null;
        ProbeFile file = JsonUtility.FromJson<ProbeFile>(File.ReadAllText(path));
        if (file.format == "ssphh-unity-probes" && file.version == 1) return file;
        EditorUtility.DisplayDialog("ssphh", path + " was not written by `ssphh probe export --to unity`", "OK");
        return null;
    }

    static Vector3 Position(ProbeFile file, int i)
    {
        return new Vector3(file.positions[3 * i], file.positions[3 * i + 1], file.positions[3 * i + 2]);
    }

    [MenuItem("Tools/ssphh/1. Place light probes")]
    static void Place()
    {
        ProbeFile file = Read();
        if (file == null) return;
        var positions = new Vector3[file.positions.Length / 3];
        for (int i = 0; i < positions.Length; ++i) positions[i] = Position(file, i);
        var group = new GameObject("ssphh light probes").AddComponent<LightProbeGroup>();
        group.probePositions = positions;
        Undo.RegisterCreatedObjectUndo(group.gameObject, "Place light probes of ssphh");
    }

    [MenuItem("Tools/ssphh/2. Set their light")]
    static void SetLight()
    {
        LightProbes probes = LightmapSettings.lightProbes;
        if (probes == null || probes.count == 0)
        {
            EditorUtility.DisplayDialog("ssphh", "There are no baked probes yet: bake the scene's lighting once", "OK");
            return;
        }
        ProbeFile file = Read();
        if (file == null) return;
        Vector3[] positions = probes.positions;
        SphericalHarmonicsL2[] light = probes.bakedProbes;
        int set = 0;
        for (int i = 0; i < positions.Length; ++i)
        {
            for (int p = 0; p < file.positions.Length / 3; ++p)
            {
                if ((Position(file, p) - positions[i]).sqrMagnitude > 1e-6f) continue;  // within a millimetre
                for (int n = 0; n < 27; ++n) light[i][n / 9, n % 9] = file.light[27 * p + n];
                ++set;
                break;
            }
        }
        probes.bakedProbes = light;
        EditorUtility.SetDirty(probes);
        Debug.Log("ssphh: " + set + " of " + positions.Length + " light probes have their light");
    }
}
#endif
