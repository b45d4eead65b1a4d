// SPDX-License-Identifier: Apache-2.0
// Tools/Surimi/Set Up: reads NAME.surimi.json (selected in the Project window) and fills in a SurimiVisibility for the
// objects of the open scene. Tools/Surimi/Check Monitors: are they where they were baked?
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEngine;

public static class SurimiSetup
{
    [System.Serializable]
    public class BakedObject
    {
        public string name;
        public int map;
        public int[] primitives; // empty: all
    }

    [System.Serializable]
    public class BakedMonitor
    {
        public string name;
        public int channel;
    }

    [System.Serializable]
    public class BakedQuad
    {
        public int channel;
        public bool twoSided;
        public float[] corners; // four times x, y, z; metres, in Unity's axes
    }

    [System.Serializable]
    public class BakedList
    {
        public int version;
        public string texture;
        public string scaleOffset;
        public string[] maps;
        public BakedObject[] objects;
        public BakedMonitor[] monitors;
        public BakedQuad[] quads;
    }

    [MenuItem("Tools/Surimi/Set Up")]
    static void SetUp()
    {
        string path;
        BakedList list = SelectedList(out path);
        if (list == null) return;
        string folder = Path.GetDirectoryName(path);
        Texture2D[] textures = new Texture2D[list.maps.Length];
        for (int i = 0; i < textures.Length; i++)
        {
            textures[i] = AssetDatabase.LoadAssetAtPath<Texture2D>(folder + "/" + list.maps[i]);
            if (textures[i] == null) Debug.LogError("Surimi: " + list.maps[i] + " is not beside " + path);
        }
        var renderers = new List<Renderer>();
        var maps = new List<Texture2D>();
        var submeshes = new List<int>();
        var found = new HashSet<string>();
        foreach (Renderer renderer in Object.FindObjectsOfType<Renderer>())
            foreach (BakedObject baked in list.objects)
            {
                if (baked.name != renderer.name) continue;
                found.Add(baked.name);
                int[] parts = baked.primitives.Length > 0 ? baked.primitives : new int[] { -1 };
                foreach (int part in parts)
                {
                    renderers.Add(renderer);
                    maps.Add(textures[baked.map]);
                    submeshes.Add(part);
                }
            }
        foreach (BakedObject baked in list.objects)
            if (!found.Contains(baked.name)) Debug.LogWarning("Surimi: no renderer is called \"" + baked.name + "\"");
        SurimiVisibility component = ComponentOf(list);
        if (component == null) return;
        Undo.RecordObject(component, "Set up Surimi");
        component.texture = list.texture;
        component.scaleOffset = list.scaleOffset;
        component.renderers = renderers.ToArray();
        component.maps = maps.ToArray();
        component.submeshes = submeshes.ToArray();
        component.Apply();
        EditorUtility.SetDirty(component);
#if UDONSHARP
        UdonSharpEditor.UdonSharpEditorUtility.CopyProxyToUdon(component);
#endif
        Debug.Log("Surimi: " + found.Count + " of " + list.objects.Length + " objects have their map");
    }

    // Draws each monitor where it was baked, and says how far the scene's object of that name is from there.
    [MenuItem("Tools/Surimi/Check Monitors")]
    static void CheckMonitors()
    {
        string path;
        BakedList list = SelectedList(out path);
        if (list == null) return;
        foreach (BakedQuad quad in list.quads)
        {
            Vector3[] corners = new Vector3[4];
            for (int k = 0; k < 4; k++)
                corners[k] = new Vector3(quad.corners[3 * k], quad.corners[3 * k + 1], quad.corners[3 * k + 2]);
            for (int k = 0; k < 4; k++) Debug.DrawLine(corners[k], corners[(k + 1) % 4], Color.red, 30);
            string name = NameOf(list, quad.channel);
            GameObject monitor = GameObject.Find(name);
            MeshFilter filter = monitor == null ? null : monitor.GetComponent<MeshFilter>();
            if (filter == null || filter.sharedMesh == null)
            {
                Debug.LogWarning("Surimi: no mesh is called \"" + name + "\"; red lines show where it was baked", monitor);
                continue;
            }
            float farthest = 0;
            foreach (Vector3 corner in corners)
            {
                float nearest = float.MaxValue;
                foreach (Vector3 vertex in filter.sharedMesh.vertices)
                    nearest = Mathf.Min(nearest, Vector3.Distance(monitor.transform.TransformPoint(vertex), corner));
                farthest = Mathf.Max(farthest, nearest);
            }
            string text = "Surimi: " + name + " (channel " + "RGB"[quad.channel] + ") is " + farthest + " m from where it was baked";
            if (farthest > 0.01f) Debug.LogWarning(text, monitor);
            else Debug.Log(text, monitor);
        }
    }

    static string NameOf(BakedList list, int channel)
    {
        foreach (BakedMonitor monitor in list.monitors)
            if (monitor.channel == channel) return monitor.name;
        return "";
    }

    static BakedList SelectedList(out string path)
    {
        path = AssetDatabase.GetAssetPath(Selection.activeObject);
        if (path == null || !path.EndsWith(".surimi.json"))
        {
            Debug.LogError("Surimi: select NAME.surimi.json in the Project window first");
            return null;
        }
        return JsonUtility.FromJson<BakedList>(File.ReadAllText(path));
    }

    // The component that sets the same property of the shader, or a new one.
    static SurimiVisibility ComponentOf(BakedList list)
    {
        foreach (SurimiVisibility one in Object.FindObjectsOfType<SurimiVisibility>())
            if (string.IsNullOrEmpty(one.texture) || one.texture == list.texture) return one;
#if UDONSHARP
        Debug.LogError("Surimi: add the component SurimiVisibility to an object of the scene first");
        return null;
#else
        GameObject holder = new GameObject("Surimi " + list.texture);
        Undo.RegisterCreatedObjectUndo(holder, "Set up Surimi");
        return holder.AddComponent<SurimiVisibility>();
#endif
    }
}
